"""Measures the accuracy of many drives in several modes: the tool tools/evaluate/bench_accuracy."""

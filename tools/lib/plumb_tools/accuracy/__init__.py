"""Accuracy of many drives in several modes and with several seeds: tools/evaluate/bench_accuracy."""

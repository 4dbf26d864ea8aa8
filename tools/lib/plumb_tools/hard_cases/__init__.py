"""Runs the hard drives of tests/hard_cases: the tool tools/evaluate/hard_cases."""

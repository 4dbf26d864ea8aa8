"""The hard drives of tests/hard_cases and what comes out of them: tools/evaluate/hard_cases."""

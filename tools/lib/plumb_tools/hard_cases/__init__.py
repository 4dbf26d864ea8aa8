"""The hard drives of tests/hard_cases/cases.toml and what comes out of them: tools/evaluate/hard_cases."""

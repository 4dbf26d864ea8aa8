"""The parts of documents_test.py."""

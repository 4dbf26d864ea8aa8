"""Holds the parts of documents_test.py."""

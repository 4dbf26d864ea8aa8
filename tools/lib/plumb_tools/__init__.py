"""What the Python tools share, and the tools that are longer than a screen.

The scripts in tools/ are thin entries: each puts this package's folder on the path and calls the
main() of one module. Only the standard library is used.
"""

"""Checks that what the documents name exists, and that a reader finds the way.

Usage: documents_test.py ROOT BIN

It checks in every Markdown file of the checkout:
- programs, their subcommands and options (by --help), scripts and their options,
- settings (by --print-config), also in TOML examples, messages, fields, constants and channels,
- CAN frames, identifiers and signals (by the DBC),
- paths, file names and identifiers in code, links and headings.
It checks for the documents as a whole: the limits of README.md and of every document, whether a
chain of links leads from README.md to each, the table of processes against their sources, and the
diagram of docs/architecture.md.

Names that belong to others, and those that a recipe invents, stand in foreign_names.txt. The self-test
comes first: it puts one wrong name of each kind into a text and expects it to be found.
"""
import pathlib
import sys

sys.dont_write_bytecode = True
from documents.self_test import self_test
from documents.tree import Tree
from documents.whole import check_all


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    tree = Tree(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
    self_test(tree)
    problems = list(check_all(tree))
    print("\n".join(problems) if problems else f"{len(tree.documents)} documents name nothing that does not exist")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()

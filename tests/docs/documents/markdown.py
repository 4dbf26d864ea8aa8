"""Takes Markdown apart as far as the checks need it."""
import re

_FENCED = re.compile(r"^[ \t]*```(\w*)[^\n]*\n(.*?)^[ \t]*```", re.S | re.M)
_INDENTED = re.compile(r"(?:(?<=\n\n)|\A)(?:(?: {4,}\S[^\n]*)?\n)+", re.M)


def fenced(text, language):
    """Contents of the fenced blocks of a language."""
    return [body for name, body in _FENCED.findall(text) if name == language]


def spans(text):
    """Contents of the inline code."""
    return re.findall(r"(?<!`)`([^`\n]+)`(?!`)", _FENCED.sub("", text))


def commands(text):
    """Inline code and the lines of all code blocks.

    A backslash at the end of a line joins it with the next.
    """
    lines = []
    for _, body in _FENCED.findall(text):
        lines += body.replace("\\\n", " ").splitlines()
    for block in _INDENTED.findall(_FENCED.sub("", text)):
        lines += block.replace("\\\n", " ").splitlines()
    return spans(text) + [line for line in lines if line.strip()]


def prose(text):
    """The text without code blocks."""
    return _INDENTED.sub("\n", _FENCED.sub("", text))


def links(text):
    return re.findall(r"\]\(([^)\s]+)\)", _FENCED.sub("", text))


def anchors(text):
    """The anchors of the headings, as GitHub makes them."""
    heads = re.findall(r"^#+ (.*)$", _FENCED.sub("", text), re.M)
    return {re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in heads}

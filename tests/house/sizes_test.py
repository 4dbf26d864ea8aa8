"""Holds the sizes that CONTRIBUTING.md states: lines of a file, lines of a function.

Usage: sizes_test.py ROOT

A function's length counts from its opening to its closing brace. The parser only matches braces: it
knows comments, literals and preprocessor lines, takes a block that follows a parameter list for a
function, and leaves out the blocks inside it. Lambdas count as part of the function around them.
"""

import pathlib
import re
import statistics
import sys

MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 60
MAX_FUNCTION_P90 = 30
FOLDERS = ("core", "platform", "modules", "tools", "tests")

_TOKENS = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"(?P<tag>[^(\s]*)\(.*?\)(?P=tag)"|"(?:\\.|[^"\\\n])*"|(?<!\w)'(?:\\.|[^'\\\n])+'""", re.S)
# What stands before the brace of a function: a parameter list, then perhaps qualifiers, a trailing
# return type or a constructor's initialisers.
_FUNCTION_HEAD = re.compile(
    r"\)\s*(const|noexcept|override|final|mutable|try|&|&&|->\s*[\w:<>,\s*&]+|:\s*.+|requires\s*.+)*\s*$", re.S)
_NOT_FUNCTION = re.compile(r"\b(namespace|class|struct|enum|union)\b[^()]*$|=\s*$|^\s*$", re.S)


def without_literals(text):
    """Replaces comments and literals by blanks. Line breaks stay."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group(0))
    text = _TOKENS.sub(blank, text)
    return re.sub(r"^[ \t]*#(?:\\\n|[^\n])*", blank, text, flags=re.M)


def function_lengths(text):
    """Finds the functions of a C++ source. Returns [(first line, number of lines)]."""
    code = without_literals(text)
    found, stack, head_start, is_function, after_function = [], [], 0, False, False
    for match in re.finditer(r"[{};]", code):
        at, kind = match.start(), match.group(0)
        if kind == "{":
            inside = any(is_function for is_function, _ in stack)
            head = code[head_start:at]
            # After "member_{value}" in a constructor's initialisers, more of them or the body may
            # follow.
            goes_on = after_function and bool(re.match(r"\s*(,.*)?$", head, re.S))
            is_function = not inside and (goes_on or (
                not _NOT_FUNCTION.search(head) and bool(_FUNCTION_HEAD.search(head))))
            stack.append((is_function, at))
        elif kind == "}" and stack:
            is_function, start = stack.pop()
            if is_function and not any(outer for outer, _ in stack):
                first = code.count("\n", 0, start) + 1
                found.append((first, code.count("\n", start, at) + 1))
        after_function = kind == "}" and bool(found) and is_function
        head_start = at + 1
    return found


def check(root):
    """Returns messages about what is too long, and a line of figures."""
    problems, files, functions = [], [], []
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.?pp")):
            text = path.read_text(encoding="utf8")
            name = path.relative_to(root)
            files.append(text.count("\n"))
            if files[-1] > MAX_FILE_LINES:
                problems.append(f"{name} has {files[-1]} lines, more than {MAX_FILE_LINES}")
            for first, length in function_lengths(text):
                functions.append(length)
                if length > MAX_FUNCTION_LINES:
                    problems.append(f"{name}:{first}: a function of {length} lines, more than {MAX_FUNCTION_LINES}")
    p90 = statistics.quantiles(functions, n=10)[-1]
    if p90 > MAX_FUNCTION_P90:
        problems.append(f"90 % of the functions have up to {p90:.0f} lines, more than {MAX_FUNCTION_P90}")
    return problems, (f"files: {len(files)}, median {statistics.median(files):.0f}, longest {max(files)}; functions: "
                      f"{len(functions)}, median {statistics.median(functions):.0f}, p90 {p90:.0f}, longest {max(functions)}")


def self_test():
    """Checks that the parser sees a long function and that braces in literals do not mislead it."""
    body = "\n".join("  g('{', \"}\");  // {" for _ in range(70))
    source = f"namespace a {{\nvoid f(int x) const {{\n{body}\n  auto l = [](int y) {{ return y; }};\n}}\nstruct S {{ int a{{0}}; }};\n}}\n"
    assert function_lengths(source) == [(2, 73)], function_lengths(source)
    assert function_lengths("C::C(int a) : b_(a), c_{1} {\n}\n") in ([(1, 2)], [(1, 1), (1, 2)])


if __name__ == "__main__":
    self_test()
    found, figures = check(pathlib.Path(sys.argv[1]))
    print(figures)
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)

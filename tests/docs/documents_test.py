"""Holds that what the documents name exists, and that a reader can find the way.

Usage: documents_test.py ROOT BIN

Checked in README.md and in every document that it leads to: programs and their options, scripts and their options,
settings, channels, message types, CAN frames, paths and file names in code, links, the limits of README.md,
reachability of every document, and the diagram of docs/architecture.md. The self-test puts one wrong name of each kind
into a text and expects it to be found.
"""

import pathlib
import re
import subprocess
import sys

MAX_README_LINES = 110
MAX_README_WORDS = 800
MAX_DOCUMENT_WORDS = 2000  # ten minutes
FOLDERS = ("core", "platform", "modules", "tools", "tests", "config", "docs", "lcmtypes", "cmake", ".ci")
# Options of other programs that may stand in a line beside ours.
FOREIGN = {"--prefix", "--lcm-url"}


def code_of(text):
    """Contents of code spans, fenced blocks and indented blocks."""
    spans = re.findall(r"(?<!`)`([^`\n]+)`(?!`)", text)
    blocks = re.findall(r"^```[^\n]*\n(.*?)^```", text, re.S | re.M)
    indented = re.findall(r"^ {4,}\S.*$", text, re.M)
    return spans + [line for block in blocks for line in block.splitlines()] + indented


class Tree:
    """What exists in the checkout and in the build."""

    def __init__(self, root, programs_folder):
        self.root = root
        self.bin = programs_folder
        self.programs = {path.name for path in programs_folder.glob("plumb-*")}
        self.help = {}
        said = subprocess.run([programs_folder / "plumb-vo", "--print-config"], capture_output=True, text=True, check=True)
        self.settings = self.read_settings(said.stdout)
        self.sections = {key.split(".")[0] for key in self.settings}
        channels = (root / "core/channels.hpp").read_text(encoding="utf8")
        self.channels = set(re.findall(r'\{"([A-Z_]+)"', channels))
        self.types = {path.stem for path in (root / "lcmtypes").glob("*.lcm")}
        lcm = "".join(path.read_text(encoding="utf8") for path in (root / "lcmtypes").glob("*.lcm"))
        constants = set(re.findall(r"const \w+ (\w+)", lcm))
        self.constants = constants | {re.sub(r"^(STATUS|REASON|CUE|CLASS)_", "", name) for name in constants}
        self.frames = set(re.findall(r"^BO_ \d+ (\w+):", (root / "config/plumbline.dbc").read_text(encoding="utf8"), re.M))
        self.environment = {name for path in (root / "tests/support").glob("*.hpp")
                            for name in re.findall(r'getenv\("(\w+)"\)', path.read_text(encoding="utf8"))}
        self.names = {path.name for folder in FOLDERS for path in (root / folder).rglob("*") if path.is_file()}

    @staticmethod
    def read_settings(text):
        keys, section = set(), ""
        for line in text.splitlines():
            if match := re.match(r"\[([\w.]+)\]", line):
                section = match.group(1)
            elif match := re.match(r"(\w+) = ", line):
                keys.add(f"{section}.{match.group(1)}")
        return keys

    def options_of(self, program):
        if program not in self.help:
            said = subprocess.run([self.bin / program, "--help"], capture_output=True, text=True).stdout
            for command in re.findall(r"^  ([a-z]+) {2,}\S", said, re.M):
                said += subprocess.run([self.bin / program, command, "--help"], capture_output=True, text=True).stdout
            self.help[program] = said
        return self.help[program]

    def script_text(self, path):
        text = (self.root / path).read_text(encoding="utf8", errors="replace")
        package = self.root / "tools/lib/plumb_tools"
        if "plumb_tools" in text and package.is_dir():
            text += "".join(p.read_text(encoding="utf8") for p in package.rglob("*.py"))
        return text


def check_programs(text, tree):
    for name in sorted(set(re.findall(r"(?<![\w/.-])plumb-[a-z0-9]+\b", text))):
        if name not in tree.programs:
            yield f"no program {name}"


def check_options(code, tree):
    for line in code:
        for command in re.split(r"\s+&\s*|\s*;\s*|\s+\|\s+", line):
            program = re.search(r"\bplumb-[a-z0-9]+", command)
            script = re.search(r"(?<![\w/])tools/[\w/]+", command)
            # What stands before our program's name is for another one, valgrind for example.
            ours = command[(script or program).end():] if script or program else ""
            options = set(re.findall(r"(?<!\S)(--[a-z][a-z0-9-]*)", ours)) - FOREIGN
            if script and (tree.root / script.group(0)).is_file():
                known, where = tree.script_text(script.group(0)), script.group(0)
            elif program and program.group(0) in tree.programs:
                known, where = tree.options_of(program.group(0)) + " --help --version --print-config", program.group(0)
            else:
                continue
            for option in sorted(options):
                if option not in known:
                    yield f"{where} has no option {option}"


def check_settings(code, tree):
    for item in code:
        for key in re.findall(r"(?<![\w./-])([a-z]+(?:\.[a-z_0-9]+)+)(?![\w/(-])", item):
            if key.split(".")[0] not in tree.sections or re.search(r"\.(cpp|hpp|md|toml|lcm|txt|py|dbc|csv|can)$", key):
                continue
            if key not in tree.settings and not any(known.startswith(key + ".") for known in tree.settings):
                yield f"no setting {key}"


def prose_of(text):
    """Everything but code, and the code spans that are a single word."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    text = re.sub(r"^ {4,}\S.*$", "", text, flags=re.M)
    return re.sub(r"(?<!`)`([^`\n]+)`(?!`)", lambda span: span.group(1) if re.fullmatch(r"\w+", span.group(1)) else "", text)


def check_messages(text, code, tree):
    for name in sorted(set(re.findall(r"\b[A-Z]{2,}(?:_[A-Z]+)+\b", prose_of(text)))):
        defined_here = any(name in block for block in re.findall(r"^```[^\n]*\n(.*?)^```", text, re.S | re.M))
        if name not in tree.channels | tree.constants | tree.environment and not defined_here:
            yield f"neither a channel nor a constant of a message: {name}"
    for name in sorted({name for item in code for name in re.findall(r"(?<![\w.:])([a-z]\w*_t)\b", item)}):
        if name not in tree.types and not re.fullmatch(r"u?int\d+_t|size_t", name):
            yield f"no message {name}"
    for name in sorted(set(re.findall(r"\bPLB_\w+", text))):
        if name not in tree.frames:
            yield f"no CAN frame {name}"


def check_paths(code, tree):
    top = "|".join(re.escape(folder) for folder in FOLDERS)
    for item in code:
        for path in re.findall(rf"(?<![\w/.$-])((?:{top})/[\w./*-]*[\w*])", item):
            if "*" in path:
                if not list(tree.root.glob(path)):
                    yield f"nothing matches {path}"
            elif not (tree.root / path).exists() and not list(tree.root.glob(path + ".*")):
                yield f"no file {path}"
        if re.fullmatch(r"[\w]+\.(?:cpp|hpp|cmake|lcm)", item) and item not in tree.names:
            yield f"no file named {item}"


def check_links(text, path):
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"\w+://", target):
            continue
        name, _, anchor = target.partition("#")
        file = (path.parent / name).resolve() if name else path
        if not file.exists():
            yield f"broken link {target}"
        elif anchor and file.suffix == ".md":
            heads = re.findall(r"^#+ (.*)$", file.read_text(encoding="utf8"), re.M)
            if anchor not in {re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in heads}:
                yield f"no heading for {target}"


def check_text(text, path, tree):
    # Names that a recipe makes up: <!-- example: NAME name.hpp -->
    for names in re.findall(r"<!-- example: (.*?) -->", text):
        for name in sorted(names.split(), key=len, reverse=True):
            text = text.replace(name, "")
    code = code_of(text)
    yield from check_programs(text, tree)
    yield from check_options(code, tree)
    yield from check_settings(code, tree)
    yield from check_messages(text, code, tree)
    yield from check_paths(code, tree)
    yield from check_links(text, path)


def reachable(root):
    """Documents that links lead to from README.md."""
    found, open_files = set(), [root / "README.md"]
    while open_files:
        path = open_files.pop()
        if path in found:
            continue
        found.add(path)
        for target in re.findall(r"\]\(([^)#\s]+\.md)[^)]*\)", path.read_text(encoding="utf8")):
            linked = (path.parent / target).resolve()
            if linked.exists():
                open_files.append(linked)
    return found


def check_all(root, tree):
    readme = (root / "README.md").read_text(encoding="utf8")
    lines, words = readme.count("\n"), len(readme.split())
    if lines > MAX_README_LINES or words > MAX_README_WORDS:
        yield f"README.md: {lines} lines and {words} words; at most {MAX_README_LINES} and {MAX_README_WORDS}"
    documents = reachable(root)
    for path in sorted(documents | set((root / "docs").glob("*.md"))):
        text = path.read_text(encoding="utf8")
        name = path.relative_to(root)
        if path not in documents:
            yield f"{name}: no link leads here from README.md"
        if len(text.split()) > MAX_DOCUMENT_WORDS:
            yield f"{name}: {len(text.split())} words, more than {MAX_DOCUMENT_WORDS}"
        for problem in check_text(text, path, tree):
            yield f"{name}: {problem}"
    drawn = subprocess.run([root / "tools/dev/diagram"], capture_output=True, text=True, check=True).stdout
    if drawn not in (root / "docs/architecture.md").read_text(encoding="utf8"):
        yield "docs/architecture.md: the diagram is stale: run tools/dev/diagram --write"


def self_test(root, tree):
    wrong = {
        "plumb-nothing": "no program", "`plumb-replay a.lcm --nothing`": "no option --nothing",
        "`tools/live a b --nothing`": "no option --nothing", "`vo.nothing_px`": "no setting",
        "`ground.filter.nothing`": "no setting", "NOTHING_AT_ALL": "neither a channel", "`nothing_t`": "no message",
        "PLB_Nothing": "no CAN frame", "`modules/nothing/nothing.cpp`": "no file", "`nothing_here.hpp`": "no file named",
        "[a](nothing.md)": "broken link", "[a](README.md#nothing)": "no heading"}
    for text, expected in wrong.items():
        problems = list(check_text(text, root / "README.md", tree))
        assert any(expected in problem for problem in problems), (text, problems)
    right = ("`plumb-replay a.lcm --poses p` `vo.max_tracks` EGO_MOTION `ego_motion_t` PLB_EgoMotion "
             "`core/numbers.hpp` [a](README.md)")
    assert not list(check_text(right, root / "README.md", tree)), list(check_text(right, root / "README.md", tree))


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    tree = Tree(root, pathlib.Path(sys.argv[2]))
    self_test(root, tree)
    problems = list(check_all(root, tree))
    print("\n".join(problems) if problems else f"{len(reachable(root))} documents name nothing that does not exist")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()

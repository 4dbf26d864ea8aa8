"""Finds what exists in the checkout and in the build."""
import functools
import os
import re
import subprocess

TOP = ("core", "lcmtypes", "platform", "modules", "config", "tools", "tests", "docs", "cmake", ".ci")
_SKIPPED = {"build", "out", ".git", "__pycache__", ".cache"}
_TEXT = (".cpp", ".hpp", ".c", ".h", ".py", ".cmake", ".lcm", ".toml", ".dbc", ".txt", ".in", ".json", "")


def run(*command):
    """What a command prints on either stream, whether it succeeds or not."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=60,
                          stdin=subprocess.DEVNULL)
    return done.stdout + done.stderr


def settings_of(toml):
    """Keys of a configuration as "section.key"."""
    keys, section = set(), ""
    for line in toml.splitlines():
        if match := re.match(r"\s*\[([\w.]+)\]", line):
            section = match.group(1)
        elif match := re.match(r"\s*(\w+) *= ", line):
            keys.add(f"{section}.{match.group(1)}")
    return keys


class Tree:
    def __init__(self, root, programs_folder):
        self.root, self.bin = root, programs_folder
        self.files = self._files()
        self.names = {path.name for path in self.files}
        self.documents = sorted(path for path in self.files if path.suffix == ".md")
        self.programs = {path.name for path in programs_folder.glob("plumb-*")}
        self.settings = settings_of(run(programs_folder / "plumb-vo", "--print-config"))
        self.sections = {key.split(".")[0] for key in self.settings}
        self._read_messages()
        dbc = (root / "config/plumbline.dbc").read_text(encoding="utf8")
        frames = re.findall(r"^BO_ (\d+) (\w+):", dbc, re.M)
        self.can_frames = {name for _, name in frames}
        self.can_ids = {int(number) for number, _ in frames}
        self.can_signals = set(re.findall(r"^ SG_ (\w+)", dbc, re.M))
        self.words = self._words()
        self.foreign = self._foreign()

    def _files(self):
        found = []
        for folder, folders, names in os.walk(self.root):
            folders[:] = sorted(name for name in folders if name not in _SKIPPED)
            found += [self.root.__class__(folder, name) for name in sorted(names)]
        return found

    def _read_messages(self):
        channels = (self.root / "core/channels.hpp").read_text(encoding="utf8")
        rows = re.findall(r'Channel (k\w+)\{"([A-Z_]+)", "(\w+)"', channels)
        self.channel_of = {constant: name for constant, name, _ in rows}
        self.publisher_of = {name: publisher for _, name, publisher in rows}
        self.fields = {}
        for path in (self.root / "lcmtypes").glob("*.lcm"):
            text = re.sub(r"//.*", "", path.read_text(encoding="utf8"))
            self.fields[path.stem] = set(re.findall(r"\b([A-Za-z]\w*)\s*(?:\[[\w\]\[]*\])*\s*(?:=[^;]*)?;", text))
        constants = {name for names in self.fields.values() for name in names if name.isupper()}
        self.constants = constants | {re.sub(r"^[A-Z]+_", "", name) for name in constants}

    def _words(self):
        """Every identifier in sources, settings and scripts, but not in documents and this test."""
        found = set()
        for path in self.files:
            below = path.relative_to(self.root).parts
            if path.suffix in _TEXT and below[:2] != ("tests", "docs") and path.name != "LICENSE":
                found.update(re.findall(r"\w+", path.read_text(encoding="utf8", errors="ignore")))
        return found

    def _foreign(self):
        text = (self.root / "tests/docs/foreign_names.txt").read_text(encoding="utf8")
        names = [line.split("#")[0].strip() for line in text.splitlines()]
        return re.compile("|".join(name for name in names if name) or r"(?!)")

    def is_foreign(self, name):
        return self.foreign.fullmatch(name) is not None

    @functools.lru_cache(maxsize=None)
    def help_of(self, program, subcommand=""):
        """The program's help without its examples, of one subcommand or of all of them."""
        if subcommand:
            return run(self.bin / program, subcommand, "--help").partition("\nExamples")[0]
        return run(self.bin / program, "--help").partition("\nExamples")[0] + "".join(
            self.help_of(program, name) for name in self.subcommands(program))

    @functools.lru_cache(maxsize=None)
    def subcommands(self, program):
        found = re.search(r"^Subcommands:\n((?: {2}\S.*\n| {10,}.*\n)*)", run(self.bin / program, "--help"), re.M)
        return set(re.findall(r"^ {2}(\w+)", found.group(1), re.M)) if found else set()

    @functools.lru_cache(maxsize=None)
    def script_help(self, script):
        """A script's help where it has one, else the comment at its head."""
        text = (self.root / script).read_text(encoding="utf8", errors="replace")
        head = "".join(re.findall(r"^#.*\n", text, re.M)) + "".join(re.findall(r'"""(.*?)"""', text, re.S)[:1])
        return run(self.root / script, "--help") if "--help" in text or "plumb_tools" in text else head

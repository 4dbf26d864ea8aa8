"""Finds names in a document that do not exist in the tree. Every check yields sentences."""
import re

from . import markdown
from .tree import TOP, settings_of

_FILE_ENDINGS = "cpp|hpp|h|c|md|toml|lcm|txt|py|dbc|csv|can|png|json|cmake|html|cfg|onnx|mp4"


def has_option(text, option):
    return re.search(re.escape(option) + r"(?![\w-])", text) is not None


def check_programs(text, tree):
    for name in sorted(set(re.findall(r"(?<![\w/.-])plumb-[a-z0-9]+\b|(?<=/bin/)plumb-[a-z0-9]+\b", text))):
        if name not in tree.programs:
            yield f"no program {name}"


def _known_options(command, tree):
    """What a command runs, its arguments, and the help that has to list its options.

    Returns None when the command is not one of the project's.
    """
    script = re.search(r"(?<![\w/])(?:tools|tests)/[\w/]+", command)
    program = re.search(r"\b(plumb-[a-z0-9]+)(?: +([a-z]+)\b)?", command)
    if script and (tree.root / script.group(0)).is_file():
        return script.group(0), command[script.end():], tree.script_help(script.group(0))
    if program and program.group(1) in tree.programs:
        name, word = program.groups()
        subcommand = word if word in tree.subcommands(name) else ""
        return f"{name} {subcommand}".strip(), command[program.end():], tree.help_of(name, subcommand)
    return None


def check_options(text, tree):
    for line in markdown.commands(text):
        if re.match(r"--[a-z]", line):
            helps = [tree.help_of(name) for name in tree.programs]
            helps += [tree.script_help(str(path.relative_to(tree.root))) for path in sorted((tree.root / "tools").rglob("*"))
                      if path.is_file() and not path.suffix and path.stat().st_mode & 0o100]
            option = line.split()[0].split("=")[0]
            if not any(has_option(said, option) for said in helps) and not tree.is_foreign(option):
                yield f"nothing has an option {option}"
            continue
        for command in re.split(r"\s&\s|\s&$|;|\s\|\s|&&|\$\(", line):
            known = _known_options(command, tree)
            if known is None:
                continue
            name, arguments, said = known
            for option in sorted(set(re.findall(r"(?<!\S)(--[a-z][a-z0-9-]*)", arguments))):
                if not has_option(said, option):
                    yield f"{name} has no option {option}"


def check_settings(text, tree):
    for item in markdown.spans(text):
        for key in re.findall(r"(?<![\w./-])([a-z]+(?:\.[a-z_0-9*]+)+)(?![\w/(-])", item):
            if key.split(".")[0] not in tree.sections or re.search(rf"\.({_FILE_ENDINGS})$", key):
                continue
            stem = key.removesuffix(".*")
            if stem not in tree.settings and not any(known.startswith(stem + ".") for known in tree.settings):
                yield f"no setting {key}"
    for block in markdown.fenced(text, "toml"):
        for key in sorted(settings_of(block) - tree.settings):
            yield f"no setting {key}"


def check_messages(text, tree):
    code = "\n".join(markdown.commands(text))
    known = tree.constants | set(tree.publisher_of)
    for name in sorted(set(re.findall(r"\b[A-Z]{2,}(?:_[A-Z0-9]+)+\b", text))):
        if name not in known and name not in tree.words and not tree.is_foreign(name):
            yield f"neither a channel nor a constant of a message: {name}"
    for name in {item for item in markdown.spans(text) if re.fullmatch(r"[A-Z]{3,}", item)}:
        if name not in known and not tree.is_foreign(name) and not (tree.root / name).exists():
            yield f"no channel {name}"
    for name, field in sorted(set(re.findall(r"(?<![\w.:])([a-z]\w*_t)\b(?:\.([A-Za-z]\w*\b(?!\*)))?", code))):
        if re.fullmatch(r"u?int\d+_t|size_t|bot_core|image_metadata_t", name) or tree.is_foreign(name):
            continue
        if name not in tree.fields:
            yield f"no message {name}"
        elif field and field not in tree.fields[name] and field != "lcm":
            yield f"{name} has no field {field}"


def check_can(text, tree):
    node = next(iter(tree.can_frames)).split("_")[0]
    for name in sorted(set(re.findall(rf"\b{node}_\w+", text))):
        if name not in tree.can_frames:
            yield f"no CAN frame {name}"
    low, high = min(tree.can_ids), max(tree.can_ids)
    for number in sorted(set(re.findall(r"\b0x([0-9A-F]{3})\b", text))):
        if low <= int(number, 16) <= high and int(number, 16) not in tree.can_ids:
            yield f"no CAN frame has the identifier 0x{number}"


def _path_exists(path, tree):
    choices = re.sub(r"\{[^}]*\}", "*", path)
    return bool(list(tree.root.glob(choices.rstrip("/")))) or bool(list(tree.root.glob(choices + ".*")))


def check_paths(text, tree):
    top = "|".join(re.escape(folder) for folder in TOP)
    for item in markdown.commands(text):
        for path in re.findall(rf"(?<![\w/.$<-])((?:{top})/[\w./*{{}},-]*[\w*}}])", item):
            if not _path_exists(path, tree) and not tree.is_foreign(path):
                yield f"no file {path}"
        for name in re.findall(r"build/\w+/tests/(\w+)", item):
            if name not in tree.words:
                yield f"no test program {name}"
    for item in markdown.spans(text):
        if re.fullmatch(r"[\w]+\.(?:cpp|hpp|cmake|lcm|py)", item) and item not in tree.names and not tree.is_foreign(item):
            yield f"no file named {item}"


def check_identifiers(text, tree):
    """Checks identifiers: words with an underscore, or with several capitals such as kConstants."""
    for item in markdown.spans(text):
        for name in set(re.findall(rf"(?<![\w/.-])[A-Za-z_]\w*\b(?!\.(?:{_FILE_ENDINGS})\b)", item)):
            if not re.search(r"[a-z0-9]_[A-Za-z0-9]|[a-z][A-Z]", name) or name in tree.words or name.endswith("_t"):
                continue
            known = name in tree.can_signals | tree.can_frames | set(tree.fields) or tree.is_foreign(name)
            if not known and not any(name in path.parts or name == path.stem for path in tree.files):
                yield f"no source has the word {name}"


CHECKS = (check_programs, check_options, check_settings, check_messages, check_can, check_paths, check_identifiers)


def check_names(text, tree):
    for check in CHECKS:
        yield from check(text, tree)

"""Checks the documents as a whole.

This includes links, limits, reachability, the table of processes and the diagram.
"""
import re

from . import markdown
from .names import check_names
from .tree import run

MAX_README_LINES = 110
MAX_README_WORDS = 800
MAX_DOCUMENT_WORDS = 2000  # read end to end in ten minutes


def target_of(link, path):
    """File and anchor of a relative link; None for a link to elsewhere."""
    if re.match(r"\w+:", link):
        return None
    name, _, anchor = link.partition("#")
    return (path.parent / name).resolve() if name else path, anchor


def check_links(text, path):
    for link in markdown.links(text):
        if (target := target_of(link, path)) is None:
            continue
        file, anchor = target
        if not file.exists():
            yield f"broken link {link}"
        elif anchor and file.suffix == ".md" and anchor not in markdown.anchors(file.read_text(encoding="utf8")):
            yield f"no heading for {link}"


def check_limits(name, text):
    lines, words = text.count("\n"), len(text.split())
    if name == "README.md" and (lines > MAX_README_LINES or words > MAX_README_WORDS):
        yield f"{lines} lines and {words} words, more than {MAX_README_LINES} and {MAX_README_WORDS}"
    if words > MAX_DOCUMENT_WORDS:
        yield f"{words} words, more than {MAX_DOCUMENT_WORDS}"


def reachable(tree):
    """Documents to which links lead from README.md. A link to a folder leads to its README.md."""
    found, waiting = set(), [tree.root / "README.md"]
    while waiting:
        path = waiting.pop()
        path = path / "README.md" if path.is_dir() else path
        if path in found or path not in tree.documents:
            continue
        found.add(path)
        targets = (target_of(link, path) for link in markdown.links(path.read_text(encoding="utf8")))
        waiting += [target[0] for target in targets if target]
    return found


def channels_of(process, tree):
    """What a process reads and writes, by its source and core/channels.hpp, without health."""
    source = (tree.root / f"modules/processes/plumb_{process}.cpp").read_text(encoding="utf8")
    used = {tree.channel_of[name] for name in re.findall(r"\bk[A-Z]\w+", source) if name in tree.channel_of}
    used |= {name for name, publisher in tree.publisher_of.items() if publisher == process}
    used = {name for name in used if not name.startswith("HEALTH_")}
    writes = {name for name in used if tree.publisher_of[name] == process}
    return used - writes, writes


def check_process_table(text, tree):
    rows = re.findall(r"^\| plumb-(\w+)[^|]*\|([^|]*)\|([^|]*)\|", text, re.M)
    sources = {path.stem.removeprefix("plumb_") for path in (tree.root / "modules/processes").glob("plumb_*.cpp")}
    for name in sorted(sources ^ {name for name, _, _ in rows}):
        yield f"the table of processes and modules/processes differ in plumb-{name}"
    for name, *columns in rows:
        for said, real, verb in zip(columns, channels_of(name, tree) if name in sources else (), ("reads", "writes")):
            words = {word for word in re.findall(r"[A-Z_]{3,}", said) if word in tree.publisher_of}
            if words != real:
                yield f"plumb-{name} {verb} {', '.join(sorted(real)) or 'nothing'}, not {', '.join(sorted(words))}"


def check_diagram(tree):
    drawn = run(tree.root / "tools/dev/diagram")
    if drawn not in (tree.root / "docs/architecture.md").read_text(encoding="utf8"):
        yield "docs/architecture.md: the diagram is stale: run tools/dev/diagram --write"


def check_all(tree):
    found = reachable(tree)
    for path in tree.documents:
        text, name = path.read_text(encoding="utf8"), path.relative_to(tree.root).as_posix()
        problems = list(check_names(text, tree)) + list(check_links(text, path)) + list(check_limits(name, text))
        if name == "README.md":
            problems += check_process_table(text, tree)
        if path not in found:
            problems.append("no link leads here from README.md")
        yield from (f"{name}: {problem}" for problem in problems)
    yield from check_diagram(tree)

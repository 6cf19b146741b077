#!/usr/bin/env python3
"""decisions_gate.py ROOT: the form of docs/decisions/NNNN_name.md.

A title `# NNNN Title`, a line `State: accepted` or `State: superseded by [NNNN](file)` (more may follow
behind a full stop or semicolon), and the five headings in this order, each with text. Numbers are given
once and without gaps; whatever names a decision by its file, here or in the code, names one that exists. Exit status 1, one line per problem."""

import pathlib
import re
import sys

HEADINGS = ["Context", "Decision", "Consequences", "Figures", "Tried and dropped"]
STATE = re.compile(r"State: (accepted|superseded by \[\d{4}\]\([\w.]+\))(\.|;|$)")
LINK = re.compile(r"\]\((\d{4}_\w+\.md)\)")
NAMED = re.compile(r"decisions/(\d{4}_\w+\.md)")


def decision_problems(path, text):
    lines = text.split("\n")
    number = path.name[:4]
    if not re.match(rf"# {number} \S", lines[0]):
        yield 1, f"the title is not `# {number} ...`"
    if not STATE.match(lines[1] if len(lines) > 1 else ""):
        yield 2, "the second line is not `State: accepted` or `State: superseded by [NNNN](file)`"
    parts = re.split(r"^## (.*)$", text, flags=re.M)
    if parts[1::2] != HEADINGS:
        yield 1, f"the headings are {', '.join(parts[1::2]) or 'none'}; expected: {', '.join(HEADINGS)}"
    for heading, body in zip(parts[1::2], parts[2::2]):
        if not body.strip():
            yield 1, f"nothing stands under `{heading}`"
    for name in LINK.findall(text):
        if not (path.parent / name).exists():
            yield 1, f"the link {name} leads nowhere"


def problems(root):
    paths = sorted((root / "docs/decisions").glob("*.md"))
    for position, path in enumerate(paths, 1):
        if not path.name.startswith(f"{position:04d}_"):
            yield path, 1, f"number {position:04d} is missing or given twice"
            break
    for path in paths:
        for line, text in decision_problems(path, path.read_text()):
            yield path, line, text
    names = {path.name for path in paths}
    for folder in ("core", "plugins", "tools", "tests", "docs"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".md", ".hpp", ".cpp", ".py", ".txt") or not path.is_file() \
                    or path.parent == root / "tests/docs":
                continue
            for number, line in enumerate(path.read_text(errors="replace").split("\n"), 1):
                for name in set(NAMED.findall(line)) - names:
                    yield path, number, f"there is no decision {name}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = list(problems(root))
    for path, line, text in found:
        print(f"{path.relative_to(root)}:{line}: {text}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""glossary_gate.py ROOT: every row of the glossary has a term, a meaning and a source, terms stand in
alphabetical order within their table and once, and relative links of all pages lead to a file, with
#anchors to a heading. Files and folders that pages name in `back ticks`, also as commands, exist. Exit status 1, one line per problem."""

import pathlib
import re
import sys

PATH = re.compile(r"`((?:core|plugins|tools|tests|docs|scenarios)/[\w./]+)(?: [^`]*)?`")
STANDS_FOR_ANY = re.compile(r"/(?!README)[A-Z]+\b")
LINK = re.compile(r"\]\((?!https?://|mailto:)([^)\s]*)\)")


def anchors(text):
    for heading in re.findall(r"^#+ (.*)$", text, re.M):
        yield re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")


def link_problems(root):
    pages = [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").rglob("*.md")),
             *sorted((root / "plugins").rglob("*.md")), *sorted((root / "scenarios").rglob("*.md")), *sorted((root / "third_party").rglob("*.md"))]
    for page in pages:
        if not page.exists():
            continue
        for number, line in enumerate(page.read_text().split("\n"), 1):
            for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
                name, _, anchor = target.partition("#")
                path = page.parent / name if name else page
                if not path.exists():
                    yield page, number, f"the link {target} leads nowhere"
                elif anchor and path.suffix == ".md" and anchor not in anchors(path.read_text()):
                    yield page, number, f"the link {target} names a heading that is not there"


def path_problems(root):
    pages = [root / "CONTRIBUTING.md", *sorted((root / "docs").rglob("*.md"))]
    for page in pages:
        if not page.exists():
            continue
        for number, line in enumerate(page.read_text().split("\n"), 1):
            for name in PATH.findall(line):
                # A unit may be named without .hpp and .cpp; PAGE.csv stands for any page's.
                if not STANDS_FOR_ANY.search(name) and not any((root / (name + end)).exists() for end in ("", ".hpp", ".cpp")):
                    yield page, number, f"there is no {name}"


def glossary_problems(page):
    terms = set()
    before = ""
    is_table = False
    text = page.read_text().split("## Words that identifiers do not use")[0]
    for number, line in enumerate(text.split("\n"), 1):
        if not line.startswith("|"):
            is_table, before = False, ""
            continue
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if cells[0] == "term" or set(cells[0]) <= set("- "):
            is_table = True
            continue
        if len(cells) != 3 or not all(cells):
            yield page, number, "a row has a term, a meaning and a source"
            continue
        if not is_table:
            yield page, number, "a row outside a table"
        if cells[0].lower() < before:
            yield page, number, f"'{cells[0]}' stands behind '{before}'"
        if cells[0] in terms:
            yield page, number, f"'{cells[0]}' is given twice"
        terms.add(cells[0])
        before = cells[0].lower()


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = [*glossary_problems(root / "docs/architecture/glossary.md"), *link_problems(root),
             *path_problems(root)]
    for path, line, text in found:
        print(f"{path.relative_to(root)}:{line}: {text}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

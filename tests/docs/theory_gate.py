#!/usr/bin/env python3
"""theory_gate.py ROOT [--shrink]: the equations of docs/theory and who cites them.

Every displayed equation ($$ ... $$) of a page carries one number, \\tag{n}, and the numbers of a page
are 1, 2, 3, ... in order. Code and pages cite in one form, `docs/theory/grains.md, eq. (7)` or
`docs/theory/grains.md, eq. (6), (7)`; a page may also write `[grains.md](grains.md), eq. (7)`.
A cited number must exist. What the engine computes must be cited by the code that computes it: an
equation without a citation in core or plugins has to stand in DERIVATIONS, or, from before this gate,
in equations_uncited.txt, which only shrinks (--shrink takes out what is cited by now). Exit status 1,
one line per problem."""

import pathlib
import re
import sys

# Equations that explain and are not computed by a stage.
DERIVATIONS = {
    "coupling": {1, 2, 6, 8, 9, 17, 18, 20, 22},
    "fluid": {9},
    "rare_grains": {3},
}
DISPLAY = re.compile(r"\$\$(.*?)\$\$", re.S)
TAG = re.compile(r"\\tag\{([^}]*)\}")
NUMBERS = r"((?:\(\d+\))(?:,? (?:and )?\(\d+\))*)"
CITED = re.compile(r"docs/theory/(\w+)\.md,? eqs?\.\s+(?://+ )?" + NUMBERS)
LINKED = re.compile(r"\((?:[\w./]*/)?(\w+)\.md\),? eqs?\.\s+" + NUMBERS)
# A plain-text equation in a block of code; commands are not meant.
PLAIN = re.compile(r"^    \S.* (=|<-|:=) ")
SOURCES = {".hpp", ".cpp", ".h", ".in", ".md", ".py"}


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def page_problems(path, text, numbers):
    for block in DISPLAY.finditer(text):
        tags = TAG.findall(block[1])
        line = line_of(text, block.start())
        if len(tags) != 1:
            yield path, line, f"an equation has {len(tags) or 'no'} number{'s' * (len(tags) > 1)}; " \
                              f"end it with \\tag{{n}}"
            continue
        wanted = str(len(numbers) + 1)
        if tags[0] in numbers:
            yield path, line, f"the number ({tags[0]}) is given twice"
        elif tags[0] != wanted:
            yield path, line, f"the number ({tags[0]}) stands where ({wanted}) should"
        numbers.append(tags[0])
    outside = DISPLAY.sub(lambda m: "\n" * m[0].count("\n"), text)
    for number, line in enumerate(outside.split("\n"), 1):
        if "$$" in line:
            yield path, number, "a $$ without its partner"
        if PLAIN.match(line) and "--set" not in line:
            yield path, number, "an equation in plain text; write it as $$ ... \\tag{n} $$"


def files(root):
    for folder in ("core", "plugins", "tools", "tests", "docs"):
        for path in sorted((root / folder).rglob("*")):
            if path.is_file() and path.suffix in SOURCES and path.parent != root / "tests/docs":
                yield path


def citations(path, text):
    found = list(CITED.finditer(text))
    if path.suffix == ".md":
        found += LINKED.finditer(text)
    for match in found:
        for number in re.findall(r"\d+", match[2]):
            yield line_of(text, match.start()), match[1], number


def uncited_allowed(path):
    """Equations that no code cites yet: {(page, number)}."""
    lines = path.read_text().split("\n") if path.exists() else []
    return {tuple(line.split()) for line in lines if line and not line.startswith("#")}


def problems(root, derivations, allowed=frozenset()):
    theory = {}
    for path in sorted((root / "docs/theory").glob("*.md")):
        numbers = theory.setdefault(path.stem, [])
        yield from page_problems(path, path.read_text(), numbers)
    cited = {page: set() for page in theory}
    for path in files(root):
        text = path.read_text(errors="replace")
        for line, page, number in citations(path, text):
            if page not in theory:
                if path.suffix != ".md" or f"theory/{page}.md" in text:
                    yield path, line, f"there is no page docs/theory/{page}.md"
            elif number not in theory[page]:
                yield path, line, f"docs/theory/{page}.md has no equation ({number})"
            elif path.relative_to(root).parts[0] in ("core", "plugins"):
                cited[page].add(number)
    for page, number in sorted(allowed):
        if number in cited.get(page, ()) or number not in theory.get(page, ()):
            yield root / f"docs/theory/{page}.md", 1, \
                f"equation ({number}) is cited by now or gone; take it out of equations_uncited.txt"
    for page, numbers in theory.items():
        derived = {str(n) for n in derivations.get(page, ())}
        path = root / f"docs/theory/{page}.md"
        for number in numbers:
            if number not in cited[page] | derived and (page, number) not in allowed:
                yield path, 1, f"no stage of core or plugins cites equation ({number})"
        for number in sorted(derived & cited[page]):
            yield path, 1, f"equation ({number}) is cited by code and listed as a derivation"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    path = pathlib.Path(__file__).parent / "equations_uncited.txt"
    allowed = uncited_allowed(path)
    if "--shrink" in sys.argv:
        told = "\n".join(f"{p.stem} {text}" for p, _, text in problems(root, DERIVATIONS, allowed))
        allowed = {(page, n) for page, n in allowed
                   if f"{page} equation ({n}) is cited by now or gone" not in told}
        head = [line for line in path.read_text().split("\n") if line.startswith("#")]
        entries = sorted(allowed, key=lambda entry: (entry[0], int(entry[1])))
        path.write_text("\n".join(head + [" ".join(entry) for entry in entries]) + "\n")
    found = list(problems(root, DERIVATIONS, allowed))
    for path, line, text in found:
        print(f"{path.relative_to(root)}:{line}: {text}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

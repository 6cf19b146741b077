#!/usr/bin/env python3
"""words_gate.py ROOT [--shrink]: the words that identifiers do not use.

The words are the left column of the last table of docs/architecture/glossary.md. An identifier of a C++
source that holds one, as whole words between underscores or capitals, fails unless it stands in
words_allowed.txt; one that stands there and is gone fails, too (--shrink takes it out)."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import allow_list
import cpp_text

FOLDERS = ("core", "plugins", "tools", "tests")
IDENTIFIER = re.compile(r"\b[A-Za-z_]\w*\b")
WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")


def words_of(identifier):
    return "_" + "_".join(w.lower() for w in WORD.findall(identifier)) + "_"


def unwanted(glossary):
    """word -> folders where it is right."""
    table = glossary.split("## Words that identifiers do not use", 1)[1]
    out = {}
    for line in table.split("\n"):
        if not line.startswith("| `"):
            continue
        cell = line.split("|")[1]
        words, _, folders = cell.partition("(")
        for word in re.findall(r"`([^`]+)`", words):
            out[word] = tuple(re.findall(r"`([^`]+)`", folders))
    return out


def findings(root):
    words = unwanted((root / "docs/architecture/glossary.md").read_text())
    pattern = re.compile("_(" + "|".join(sorted(map(re.escape, words), key=len, reverse=True)) + ")(?=_)")
    found = {}
    for path in cpp_text.sources(root, FOLDERS):
        name = path.relative_to(root).as_posix()
        text = cpp_text.code_only(path.read_text(errors="replace"))
        for match in IDENTIFIER.finditer(text):
            identifier = match[0]
            if identifier in found:
                continue
            for word in pattern.findall(words_of(identifier)):
                if not any(name.startswith(folder) for folder in words[word]):
                    line = text.count("\n", 0, match.start()) + 1
                    found[identifier] = f"{name}:{line}"
    return found


def main():
    here = pathlib.Path(__file__).parent
    return allow_list.run(findings(allow_list.root_of(sys.argv[1:])), here / "words_allowed.txt",
                          "see the words of docs/architecture/glossary.md", sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())

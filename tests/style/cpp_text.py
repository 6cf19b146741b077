"""C++ sources as the gates read them."""

import re

SUFFIXES = {".hpp", ".cpp", ".h", ".in"}
# In this order: raw strings, strings, characters (not the ' of 1'000), comments.
PIECES = re.compile(r'R"([^(\s]*)\((.*?)\)\1"'
                    r'|"(?:\\.|[^"\\\n])*"'
                    r"|(?<![0-9A-Za-z_])'(?:\\.|[^'\\\n])+'"
                    r"|//[^\n]*|/\*.*?\*/", re.S)


def code_only(text):
    """Comments and the insides of strings become blanks; lines stay where they are."""
    def blank(match):
        piece = match[0]
        kept = re.sub(r"[^\n]", " ", piece)
        return '"' + kept[1:-1] + '"' if piece[0] in "R\"" and "\n" not in piece else kept
    return PIECES.sub(blank, text)


def sources(root, folders):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SUFFIXES and path.is_file():
                yield path


def end_of_block(lines, n, statement):
    """The first line from `n` on that closes what `statement` left open; the last line if none does."""
    depth = statement.count("{") - statement.count("}")
    while n < len(lines):
        depth += lines[n].count("{") - lines[n].count("}")
        if depth <= 0:
            return n
        n += 1
    return n - 1

#!/usr/bin/env python3
"""functions_gate.py ROOT [--shrink]: functions of core, plugins and tools have up to 60 lines, from
the first line of the declaration to the closing brace. Kernels (DUST_KERNEL) are exempt, and so are
tables. Reads the sources as clang-format leaves them. Longer ones from before stand in functions_allowed.txt by file and name, which only
shrinks."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import allow_list
import cpp_text

FOLDERS = ("core", "plugins", "tools")
LIMIT = 60
SCOPE = re.compile(r"(inline )?(namespace|extern)\b")
TYPE = re.compile(r"(template\s*<.*?>\s*)?(typedef )?(class|struct|union|enum)\b(?!.*\)\s*(const\s*)?\{$)")
NAME = re.compile(r"((?:\w+::)*(?:~?\w+|operator\s*\S+?))\s*\(")
NOT_NAMES = {"__attribute__", "decltype", "alignas", "noexcept", "requires", "defined", "if"}


def name_of(declaration):
    for match in NAME.finditer(declaration):
        if match[1] not in NOT_NAMES:
            return match[1]
    return declaration.split("{")[0].strip()[-40:]


def functions(text):
    """(name, first line, lines, declaration) of every function with a body of its own lines."""
    lines = cpp_text.code_only(text).split("\n")
    scopes = []  # (name of the type, or None of a namespace)
    n = 0
    while n < len(lines):
        line = lines[n]
        if not line.strip() or line.lstrip().startswith("#"):
            while line.rstrip().endswith("\\") and n + 1 < len(lines):
                n += 1
                line = lines[n]
            n += 1
            continue
        if re.match(r"\s*\}", line):
            if scopes:
                scopes.pop()
            n += 1
            continue
        if re.match(r"\s*(public|private|protected):", line):
            n += 1
            continue
        first = n
        words = []
        while n < len(lines):
            words.append(lines[n].strip())
            if re.search(r"[;{}]\s*$", lines[n]):
                break
            n += 1
        declaration = " ".join(w for w in words if w)
        n += 1
        if not declaration.endswith("{"):
            continue
        if SCOPE.match(declaration):
            scopes.append(None)
        elif re.match(r"(typedef )?enum\b", declaration):
            n = cpp_text.end_of_block(lines, n, declaration) + 1
        elif TYPE.match(declaration):
            scopes.append(re.search(r"(?:class|struct|union|enum)\s+(?:class\s+)?([\w:]*)", declaration)[1])
        else:
            n = cpp_text.end_of_block(lines, n, declaration)
            closing = lines[n].strip()
            n += 1
            if "(" in declaration and closing == "}":
                types = [s for s in scopes if s]
                yield "::".join(types + [name_of(declaration)]), first + 1, n - first, declaration


def findings(root):
    found = {}
    for path in cpp_text.sources(root, FOLDERS):
        name = path.relative_to(root).as_posix()
        for function, line, length, declaration in functions(path.read_text(errors="replace")):
            if length > LIMIT and "DUST_KERNEL" not in declaration:
                found[f"{name} {function}"] = f"{name}:{line}: {length} lines"
    return found


def main():
    here = pathlib.Path(__file__).parent
    return allow_list.run(findings(allow_list.root_of(sys.argv[1:])),
                          here / "functions_allowed.txt",
                          f"a function has up to {LIMIT} lines; cut it by what it does",
                          sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())

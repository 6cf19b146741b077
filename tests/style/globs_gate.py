#!/usr/bin/env python3
"""globs_gate ROOT: what is built is named, not found: no file(GLOB ...) in CMake's files, and every
folder of tests that has a CMakeLists.txt is named by the one above it."""

import pathlib
import re
import sys

# Every scenario there is has its test: it need not be named.
ALLOWED = {"tests/scenario/CMakeLists.txt"}


def findings(root):
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if name.startswith(("build", ".")) or not path.is_file():
            continue
        if path.name != "CMakeLists.txt" and path.suffix != ".cmake":
            continue
        text = path.read_text()
        if re.search(r"\bfile\s*\(\s*GLOB", text) and name not in ALLOWED:
            yield f"{name}: a list of sources that is found, not named"
        above = path.parent.parent / "CMakeLists.txt"
        if name.startswith("tests/") and path.name == "CMakeLists.txt" and above.exists():
            if not re.search(rf"\b{re.escape(path.parent.name)}\b", above.read_text()):
                yield f"{name}: {above.relative_to(root).as_posix()} does not name its folder: it is never built"


def main():
    found = list(findings(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()

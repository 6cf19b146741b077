#!/usr/bin/env python3
"""format_gate.py ROOT: every C++ source stands as clang-format leaves it. Exit status 77 (skipped)
where no clang-format 14 is there, Debian 12's: others break some lines elsewhere. $CLANG_FORMAT names
another program."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

FOLDERS = ("core", "plugins", "tools", "tests")
SUFFIXES = {".hpp", ".cpp", ".h"}
VERSION = "14"
SKIPPED = 77
FILES_PER_CALL = 64


def formatter():
    """The program, or None and why not."""
    names = [os.environ["CLANG_FORMAT"]] if "CLANG_FORMAT" in os.environ else \
        [f"clang-format-{VERSION}", "clang-format"]
    for name in names:
        program = shutil.which(name)
        if program is None:
            continue
        told = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
        version = re.search(r"version (\d+)", told)
        if version and version[1] == VERSION:
            return program, ""
        return None, f"{program} is version {version[1] if version else '?'}, not {VERSION}"
    return None, f"no {' or '.join(names)} is there (Debian package clang-format)"


def unformatted(program, root, paths):
    """The files that differ, each with the first line that does."""
    out = []
    for begin in range(0, len(paths), FILES_PER_CALL):
        call = subprocess.run([program, "--dry-run", "--Werror", *paths[begin:begin + FILES_PER_CALL]],
                              cwd=root, capture_output=True, text=True)
        seen = set()
        for path, line in re.findall(r"^(\S+?):(\d+):\d+: error: ", call.stderr, re.M):
            if path not in seen:
                seen.add(path)
                out.append(f"{path}:{line}: not as clang-format leaves it; run clang-format -i {path}")
        if call.returncode and not seen:
            out.append(call.stderr.strip())
    return out


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    program, why = formatter()
    if program is None:
        print(f"skipped: {why}")
        return SKIPPED
    paths = sorted(str(p.relative_to(root)) for folder in FOLDERS
                   for p in (root / folder).rglob("*") if p.suffix in SUFFIXES and p.is_file())
    found = unformatted(program, root, paths)
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

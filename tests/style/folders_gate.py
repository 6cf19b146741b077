#!/usr/bin/env python3
"""folders_gate.py ROOT [--shrink]: a folder of core, plugins or tools holds up to 15 units.

A unit is a header and its source, by their common name. The include path of the SDK and plugins/sensor
are exempt (an author finds all of a kind there). Larger folders from before stand in
folders_allowed.txt with their number of units; that number only goes down."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import allow_list
import cpp_text

FOLDERS = ("core", "plugins", "tools")
EXEMPT = ("core/sdk/include", "plugins/sensor")
LIMIT = 15


def counts(root):
    units = {}
    for path in cpp_text.sources(root, FOLDERS):
        folder = path.parent.relative_to(root).as_posix()
        if not folder.startswith(EXEMPT):
            units.setdefault(folder, set()).add(path.stem)
    return {folder: len(names) for folder, names in units.items() if len(names) > LIMIT}


def problems(found, allowed):
    for folder, count in sorted(found.items()):
        most = allowed.get(folder)
        if most is None:
            yield f"{folder}: {count} units; a folder has up to {LIMIT}: put what belongs together " \
                  f"into a folder named by its subject"
        elif count > most:
            yield f"{folder}: {count} units, {most} are allowed: a folder that is too large takes none"
        elif count < most:
            yield f"folders_allowed.txt: {folder} has {count} units, not {most}; write the smaller number"
    for folder in sorted(set(allowed) - set(found)):
        yield f"folders_allowed.txt: {folder} is no longer too large; take it out"


def main():
    path = pathlib.Path(__file__).parent / "folders_allowed.txt"
    found = counts(allow_list.root_of(sys.argv[1:]))
    allowed = {f: int(n) for f, n in (line.rsplit(" ", 1) for line in allow_list.read(path))}
    if "--shrink" in sys.argv[1:]:
        head = [line for line in path.read_text().split("\n") if line.startswith("#")]
        allowed = {f: min(n, found[f]) for f, n in allowed.items() if f in found}
        path.write_text("\n".join(head + [f"{f} {n}" for f, n in sorted(allowed.items())]) + "\n")
    said = list(problems(found, allowed))
    for line in said:
        print(line)
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main())

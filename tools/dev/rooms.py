"""The rooms of core/ as CMake has them: what check_includes holds the sources to and draw_architecture draws."""

import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOMS = re.compile(r"foreach\(room ([^)]*)\)")
ROOM = re.compile(r"dust_room\((\w+)(.*?)\)", re.S)


def rooms():
    """room -> (rooms, packages) it may include, in the order of core/CMakeLists.txt: from the ground up."""
    out = {}
    for room in ROOMS.search((ROOT / "core/CMakeLists.txt").read_text())[1].split():
        name, arguments = ROOM.search((ROOT / "core" / room / "CMakeLists.txt").read_text()).groups()
        lists, key = {}, ""
        for word in arguments.split():
            if word in ("USES", "PACKAGES", "SOURCES"):
                key = word
            else:
                lists.setdefault(key, set()).add(word)
        if name != room:
            raise SystemExit(f"core/{room}/CMakeLists.txt declares the room {name}")
        out[room] = lists.get("USES", set()), lists.get("PACKAGES", set())
    return out

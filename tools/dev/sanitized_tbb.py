#!/usr/bin/env python3
"""Debian's oneTBB built under the thread sanitizer, for the preset tsan: one that is not built so hides from the
sanitizer how one thread waits for another, and every hand-over of work looks like a data race.

  tools/dev/sanitized_tbb.py   builds it once in build/tsan/onetbb from Debian's source package (a minute) and
                               prints the folder for LD_LIBRARY_PATH"""

import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "build" / "tsan" / "onetbb"
REMEDY = ("sanitized_tbb: the source package onetbb cannot be fetched: add 'deb-src' to the types of Debian's "
          "sources in /etc/apt, run apt-get update and install dpkg-dev")


def built():
    """The folder of a library that has been built, or None."""
    found = sorted(FOLDER.glob("build/*/libtbb.so.12"))
    return found[0].parent if found else None


def fetch():
    """Debian's source, patches applied."""
    source = FOLDER / "source"
    if source.exists():
        return source
    FOLDER.mkdir(parents=True, exist_ok=True)
    done = subprocess.run(["apt-get", "source", "--download-only", "onetbb"], cwd=FOLDER, text=True, capture_output=True)
    packages = sorted(FOLDER.glob("onetbb_*.dsc"))
    if done.returncode or not packages:
        sys.exit(f"{REMEDY}\n{done.stderr}")
    subprocess.run(["dpkg-source", "-x", packages[-1], source], check=True, stdout=subprocess.DEVNULL)
    return source


def library():
    """Folder of libtbb.so under the thread sanitizer; builds it where there is none."""
    if found := built():
        return found
    options = ["-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DTBB_SANITIZE=thread", "-DTBB_TEST=OFF", "-DTBB_STRICT=OFF",
               "-DTBBMALLOC_BUILD=OFF"]
    subprocess.run(["cmake", "-G", "Ninja", "-S", fetch(), "-B", FOLDER / "build", *options], check=True,
                   stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", FOLDER / "build"], check=True, stdout=subprocess.DEVNULL)
    return built() or sys.exit("sanitized_tbb: the build made no libtbb.so.12")


if __name__ == "__main__":
    print(library())

"""Every mistake in every shipped scenario, by the test program `mutate_scenarios` (CTest label `validation`), which is
looked for beside the engine."""

import datetime
import pathlib
import re
import subprocess
import sys
import time

from runs import ROOT

TITLE = "Mistakes in the shipped scenarios"
# Messages, no figures.
BITS = ()
RECORD = ROOT / "docs" / "validation" / "messages.md"


def plans():
    return []


def write(args):
    build = pathlib.Path(args.engine.path()).parents[1]
    source = re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", (build / "CMakeCache.txt").read_text(), re.M)[1]
    commit = subprocess.run(["git", "log", "-1", "--format=%h"], cwd=source, text=True, check=True,
                            capture_output=True).stdout.strip()
    begin = time.monotonic()
    done = subprocess.run([build / "bin" / "mutate_scenarios", pathlib.Path(source) / "scenarios",
                           build / "lib/dust/plugins", build / "bin" / "engine", "1"], text=True, stdout=subprocess.PIPE)
    minutes = (time.monotonic() - begin) / 60
    print(done.stdout)
    counts = re.findall(r"^  (\d+) x (.*)$", done.stdout, re.M)
    closing = done.stdout.strip().splitlines()[-1]
    faults = [line for line in done.stdout.splitlines() if re.match(r"\S+:\d+:\d+: ", line)]
    lines = ["# Mistakes in the shipped scenarios", "",
             f"Written by `tools/validation/run messages` on {datetime.date.today()}, commit {commit}; {minutes:.0f} min beside other",
             "work. Every key and every value of every shipped scenario is done wrong, one at a time; each mistake must be",
             "refused with `file:line:column: error: ...` at its place. Every 400th one is given to `engine run`, which must end",
             "with status 2, print nothing to standard output and make no folder. The test suite does every 17th mistake, the",
             "CTest label `validation` all of them.", "", "| mistake | times |", "|---|---|",
             *(f"| {what} | {int(count):,} |" for count, what in sorted(counts, key=lambda c: -int(c[0]))), "",
             closing[0].upper() + closing[1:] + ".", "",
             *(["What is wrong:", "", "```", *faults, "```", ""] if faults else [])]
    RECORD.write_text("\n".join(lines))
    if done.returncode:
        sys.exit(done.returncode)

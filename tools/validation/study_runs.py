"""Studies by `engine study`: running one, and reading its table."""

import csv
import datetime
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import time

from page import FOLDER
from runs import ROOT, cpu_name


def written_by(case, engine):
    return (f"Written by `tools/validation/run {case}` on {datetime.date.today()}, {cpu_name()}, {os.cpu_count()} cores (load at "
            f"the end {os.getloadavg()[1]:.0f}: times are those of a machine as busy as that), commit {engine.commit()}.")


def write_page(case, lines):
    target = FOLDER / f"{case}.md"
    target.write_text("\n".join(lines) + "\n")
    print(f"wrote {target.relative_to(ROOT)}")


def shown(file):
    """A path as the reader of the page would write it."""
    file = pathlib.Path(file).resolve()
    return str(file.relative_to(ROOT)) if file.is_relative_to(ROOT) else file.name


def table(folder):
    """Rows of study.csv without the times, which differ from run to run."""
    with open(folder / "study.csv", newline="") as file:
        return [{k: v for k, v in row.items() if k != "wall_s [s]"} for row in csv.DictReader(file)]


def finished(folder):
    try:
        return [row["hash"] for row in table(folder) if row["status"] == "finished"]
    except FileNotFoundError:
        return []


def state(folder, point):
    """SHA-256 of all grains and cells at the end of a point."""
    return json.loads((folder / "points" / point / "summary.json").read_text())["state_sha256"]


def run(args, *more, allowed=(0,)):
    """Output of `engine study`, told line by line, with the seconds it took."""
    command = [args.engine.path(), "study", *map(str, more)]
    begin, lines = time.time(), []
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    for line in process.stdout:
        print(line, end="", flush=True)
        lines.append(line.rstrip("\n"))
    if process.wait() not in allowed:
        sys.exit(f"{shlex.join(command)} ended with {process.returncode}")
    return lines, time.time() - begin


def rounded(text):
    """Numbers to five digits; anything else as it is, so also a hash of digits with one e."""
    if re.fullmatch("[0-9a-f]{16}", text):
        return text
    try:
        return f"{float(text):.5g}"
    except ValueError:
        return text


VERDICT = re.compile(r"^(\S+) (rises|falls) (.*): (as expected|against the expectation|not told from noise|no change|open: \d+ of \d+ points not steady|not enough.*?)(?:: (.*))?$")


def verdict_of(line):
    return VERDICT.match(line)


def states_of(folder, rows):
    """A short mark of all final states together."""
    text = "".join(state(folder, r["hash"]) for r in rows if r["status"] == "finished")
    return "`" + hashlib.sha256(text.encode()).hexdigest()[:12] + "`"

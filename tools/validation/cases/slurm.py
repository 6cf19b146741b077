"""Starts a cluster of this machine and runs the tests with the label `slurm`."""

import pathlib
import re
import subprocess
import sys

import study_runs

TITLE = "Studies on a Slurm cluster"
# Whether points end and resume, not what they compute.
BITS = ()


def plans():
    return []


def write(args):
    package = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${Version}", "slurmctld"],
                             capture_output=True, text=True).stdout
    command = ["ctest", "--test-dir", str(pathlib.Path(args.engine.path()).parents[1]), "-L", "slurm", "--output-on-failure", "--verbose"]
    done = subprocess.run(command, capture_output=True, text=True)
    print(done.stdout)
    passed = re.search(r"Ran (\d+) tests? in", done.stdout)
    skipped = "Skipped" in done.stdout or "skipped" in done.stdout
    results = re.findall(r"Test\s+#\d+: (slurm: \w+) \.+\s+(\S+)\s+([\d.]+) sec", done.stdout)
    out = ["# Studies on a Slurm cluster", "", study_runs.written_by("slurm", args.engine), "",
           f"`ctest -L slurm` against {package} of Debian: slurmctld and slurmd on this machine, started and "
           "stopped by the tests (`tests/slurm/cluster`).", "", "| test | result | s |", "| --- | --- | --- |"]
    out += [f"| {name} | {result} | {float(s):.0f} |" for name, result, s in results]
    out += ["", f"`slurm: study` holds {passed.group(1) if passed else '?'} cases (`tests/slurm/study_test.py`): "
            "an array gives the table of local runs; a failing point comes with its reason; a task cut off is "
            "submitted again and goes on from its checkpoint; an interrupted study cancels its jobs, a killed one "
            "finds them again."]
    if done.returncode != 0 or skipped or not passed:
        sys.exit("the tests did not pass, or were skipped; nothing written")
    study_runs.write_page("slurm", out)

#!/usr/bin/env python3
"""power_cut_test.py --engine E --scenario S --library SYNC_LOG: what a checkpoint counts on is on the disk before it.

A power cut loses what is in the cache of the disk alone. Whoever goes on from a checkpoint needs the frames and the
rows that it counts: each must have been waited for before the checkpoint took its name."""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile


def events(options, folder, log, *more):
    run = subprocess.run([options.engine, "run", options.scenario, "-o", folder, "--threads", "1", "--quiet", *more],
                         env={**os.environ, "LD_PRELOAD": str(options.library), "SYNC_LOG": str(log)},
                         capture_output=True, text=True, timeout=60)
    if run.returncode:
        sys.exit(f"FAILED: the run: {run.stderr}")
    return [line.split("\t") for line in log.read_text().splitlines()]


def check(seen, folder):
    """Counts checkpoints; ends at one that took its name too soon."""
    checkpoints, waiting, rows_are_safe, names_are_safe = 0, set(), False, False
    for what, path in seen:
        file = pathlib.Path(path)
        if what == "rename" and file.name == "checkpoint.h5":
            if waiting or not rows_are_safe or not names_are_safe:
                sys.exit(f"FAILED: checkpoint {checkpoints + 1} came before "
                         f"{sorted(waiting) or 'series.csv or the names of the frames'} on the disk")
            checkpoints, rows_are_safe = checkpoints + 1, False
        elif what == "rename" and file.parent.name == "frames":
            waiting.add(file.name)
            names_are_safe = False
        elif what == "sync" and file.parent.name == "frames":
            waiting.discard(file.name)
        elif what == "sync" and file == folder / "frames":
            names_are_safe = True
        elif what == "sync" and file == folder / "series.csv":
            rows_are_safe = True
    return checkpoints


def main():
    parser = argparse.ArgumentParser()
    for name in ("engine", "scenario", "library"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work).resolve() / "run"
        found = check(events(options, folder, pathlib.Path(work) / "first.log", "--set", "time.end=10 ms"), folder)
        resumed = check(events(options, folder, pathlib.Path(work) / "then.log", "--resume"), folder)
        # One at the start and one per 2 ms.
        if found != 6 or resumed != 3:
            sys.exit(f"FAILED: {found} and {resumed} checkpoints were seen, not 6 and 3: nothing is shown")


if __name__ == "__main__":
    main()

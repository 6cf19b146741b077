#!/usr/bin/env python3
"""kill_test.py --engine E --scenario S [--kills N]: a run that is killed at N random moments.

Each kill is a SIGKILL: no handler, no last word. After each the run goes on from what lies in its folder;
when it has ended, another one begins. Every one that ends has the bits and the series of an unbroken run."""

import argparse
import json
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time


def command(options, folder, *more):
    return [options.engine, "run", options.scenario, "-o", folder, "--threads", "1", "--quiet", *more]


def digest(folder):
    return json.loads((folder / "summary.json").read_text())["state_sha256"]


def fail(text):
    print(f"FAILED: {text}")
    sys.exit(1)


def how_to_go_on(folder):
    """From the checkpoint where there is one, else from the start."""
    if (folder / "checkpoint.h5").exists():
        return ["--resume"]
    return ["--force"] if folder.exists() else []


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--engine", required=True)
    parser.add_argument("--scenario", required=True)
    parser.add_argument("--kills", type=int, default=100)
    options = parser.parse_args()
    draw = random.Random(33)
    with tempfile.TemporaryDirectory(prefix="dust-kill-") as work:
        whole = pathlib.Path(work) / "whole"
        begin = time.monotonic()
        subprocess.run(command(options, whole), check=True)
        duration = time.monotonic() - begin
        bits, series = digest(whole), (whole / "series.csv").read_text()
        kills = ended = with_checkpoint = 0
        folder = pathlib.Path(work) / "run0"
        while kills < options.kills:
            going_on = how_to_go_on(folder)
            with_checkpoint += going_on == ["--resume"]
            process = subprocess.Popen(command(options, folder, *going_on), stderr=subprocess.PIPE, text=True)
            try:
                # Beyond the whole time, too: some runs shall end.
                _, said = process.communicate(timeout=draw.uniform(0.0, 1.3 * duration))
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.communicate()
                kills += 1
                continue
            if process.returncode != 0:
                fail(f"after {kills} kills, {' '.join(going_on)}: status {process.returncode}\n{said}")
            if digest(folder) != bits:
                fail(f"after {kills} kills: other bits than those of the unbroken run")
            if (folder / "series.csv").read_text() != series:
                fail(f"after {kills} kills: another series than that of the unbroken run")
            if list(folder.rglob("*.part")):
                fail(f"after {kills} kills: something half-written stays")
            ended += 1
            folder = pathlib.Path(work) / f"run{ended}"
        print(f"{kills} kills: {with_checkpoint} runs went on from a checkpoint, {ended} ended, all with the bits "
              "and the series of an unbroken one")
        if ended < options.kills // 20 or with_checkpoint < options.kills // 5:
            fail("the kills did not meet the runs")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`engine run --live`: the address is printed, progress and report grow while the run goes on, a signal ends it as
any other run, and the bits are those of a run that nobody watches.

    live_test.py ENGINE SOURCE"""
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

PATIENCE = 60  # seconds


def check(condition, text):
    if not condition:
        sys.exit("FAILED: " + text)


def get(address, path):
    with urllib.request.urlopen(address + path, timeout=PATIENCE) as answer:
        return answer.read().decode()


def start(engine, *arguments):
    process = subprocess.Popen([engine, "run", *map(str, arguments), "--live", "--threads", "1"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for line in process.stdout:
        found = re.match(r"live: (http://127\.0\.0\.1:\d+/)", line)
        if found:
            return process, found[1]
    sys.exit("FAILED: no address was printed:\n" + process.stderr.read())


def main():
    engine, source = sys.argv[1], pathlib.Path(sys.argv[2])
    case = [source / "tests/scenario/small_hourglass.yaml", "--set", "time.output_every=2 ms"]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        # A long run, watched and then interrupted.
        process, address = start(engine, *case, "--set", "time.end=100 s", "-o", folder / "long")
        seen, times, end = 0, [], time.time() + PATIENCE
        while len(times) < 2 and time.time() < end:
            progress = json.loads(get(address, "progress.json"))
            if progress.get("states", 0) > seen:
                seen = progress["states"]
                times.append(json.loads(get(address, "report.json"))["summary"]["simulated_s"])
            time.sleep(0.02)
        check(len(times) == 2 and times[1] >= times[0], f"the report did not grow: {times}")
        check(progress["status"] == "running" and progress["end_s"] == 100, f"progress is {progress}")
        check("goes on" in get(address, ""), "no page watches the run")
        check('"kind":"run"' in get(address, "report.html"), "no report while the run goes on")
        check(not (folder / "long/summary.json").exists(), "a run that goes on has no summary yet")
        process.send_signal(signal.SIGINT)
        check(process.wait(PATIENCE) == 130, f"ended with {process.returncode}:\n{process.stderr.read()}")
        try:
            get(address, "progress.json")
            sys.exit("FAILED: the server outlives its run")
        except (urllib.error.URLError, ConnectionError):
            pass
        # A short one beside one that nobody watches.
        short = [*case, "--set", "time.end=0.01 s"]
        process, _ = start(engine, *short, "-o", folder / "watched")
        process.communicate(timeout=PATIENCE)
        subprocess.run([engine, "run", *map(str, short), "-o", folder / "alone", "--quiet", "--threads", "1"], check=True)
        digests = {name: json.loads((folder / name / "summary.json").read_text())["state_sha256"] for name in ("watched", "alone")}
        check(digests["watched"] == digests["alone"], f"other bits when watched: {digests}")
        check((folder / "watched/series.csv").read_text() == (folder / "alone/series.csv").read_text(), "another series when watched")


main()

#!/usr/bin/env python3
"""signals_test.py --engine E --scenario S: what asks a run for an end, and what does not.

A run ends with its checkpoint and 128 + the signal, and goes on to the same bits. That nobody reads what it prints, or
that it was started by nohup and its terminal closes, is no reason to end."""

import argparse
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time


def command(options, folder, *more):
    return [options.engine, "run", options.scenario, "-o", folder, "--threads", "1", *more]


def digest(folder):
    return json.loads((folder / "summary.json").read_text())["state_sha256"]


def expect(is_true, what, said=""):
    if not is_true:
        print(f"FAILED: {what}\n{said}")
        sys.exit(1)


def started(options, folder, before=None):
    """A run that would go on for long, with its first frames written."""
    process = subprocess.Popen(command(options, folder, "--quiet", "--set", "time.end=10 s"),
                               stderr=subprocess.PIPE, text=True, preexec_fn=before)
    while process.poll() is None and not (folder / "frames" / "000002.h5").exists():
        time.sleep(0.005)
    return process


def ends_in_good_order(options, work, number, bits):
    name = signal.Signals(number).name
    folder = work / f"a run's {name}"
    process = started(options, folder)
    process.send_signal(number)
    said = process.communicate(timeout=60)[1]
    expect(process.returncode == 128 + number, f"{name}: status {process.returncode}", said)
    expect(f"""--resume -o '{work}/a run'\\''s {name}'""" in said, f"{name}: the folder is in quotes", said)
    time_reached = float(said.split("t = ")[1].split(" s")[0])
    if time_reached < 0.016:  # else it had passed the end of the whole run
        run = subprocess.run(command(options, folder, "--quiet", "--resume"), capture_output=True, text=True)
        expect(run.returncode == 0 and digest(folder) == bits, f"{name}: goes on to the same bits", run.stderr)


def listens(process, number):
    """Whether a process has a handler of the signal."""
    lines = pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines()
    caught = next((line.split()[1] for line in lines if line.startswith("SigCgt:")), "0")
    return int(caught, 16) >> (number - 1) & 1 == 1


def ends_while_it_is_made_ready(options, work, bits):
    """A signal long before the first step: there is a checkpoint to go on from all the same."""
    folder = work / "early"
    process = subprocess.Popen(command(options, folder, "--quiet"), stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not listens(process, signal.SIGINT):
        pass
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=60)[1]
    expect(process.returncode == 130, f"early: status {process.returncode}", said)
    run = subprocess.run(command(options, folder, "--quiet", "--resume"), capture_output=True, text=True)
    expect(run.returncode == 0 and digest(folder) == bits, "early: goes on to the same bits", run.stderr)


def outlives_its_terminal(options, work):
    folder = work / "nohup"
    process = started(options, folder, lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
    process.send_signal(signal.SIGHUP)
    frames = len(list((folder / "frames").iterdir()))
    end = time.monotonic() + 60
    while process.poll() is None and len(list((folder / "frames").iterdir())) < frames + 3 and time.monotonic() < end:
        time.sleep(0.005)
    expect(process.poll() is None, "a run whose SIGHUP is ignored goes on")
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    expect(process.returncode == 143, f"and ends by SIGTERM: {process.returncode}")


def goes_on_without_readers(options, work, bits):
    for name, target in (("closed", "| true"), ("full", "> /dev/full"), ("none", ">&-")):
        folder = work / name
        line = " ".join(f"'{c}'" for c in command(options, folder))
        run = subprocess.run(["bash", "-c", f"set -o pipefail; (sleep 0.2; exec {line}) {target}"],
                             capture_output=True, text=True,
                             preexec_fn=lambda: signal.signal(signal.SIGPIPE, signal.SIG_DFL))
        expect(run.returncode == 0, f"output {target}: status {run.returncode}", run.stderr)
        expect(digest(folder) == bits, f"output {target}: the bits of the whole run", run.stderr)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--engine", required=True)
    parser.add_argument("--scenario", required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="dust-signals-") as folder:
        work = pathlib.Path(folder)
        subprocess.run(command(options, work / "whole", "--quiet"), check=True)
        bits = digest(work / "whole")
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1, signal.SIGXCPU):
            ends_in_good_order(options, work, number, bits)
        ends_while_it_is_made_ready(options, work, bits)
        outlives_its_terminal(options, work)
        goes_on_without_readers(options, work, bits)


if __name__ == "__main__":
    main()

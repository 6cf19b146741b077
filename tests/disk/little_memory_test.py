#!/usr/bin/env python3
"""little_memory_test.py --engine E --scenario S: what a run says that gets less memory than it needs."""

import argparse
import pathlib
import resource
import subprocess
import sys
import tempfile

LIMIT = 3 << 30                        # bytes of address space: enough to begin
CELLS = "fluid.cells=[1000, 400, 400]"  # some 230 GB
NEED = 200e9


def free_memory():
    for line in pathlib.Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemAvailable:"):
            return 1024.0 * float(line.split()[1])
    return 0.0


def expect(is_true, what, run):
    if not is_true:
        print(f"FAILED: {what}\nstatus {run.returncode}\n{run.stdout}{run.stderr}")
        sys.exit(1)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--engine", required=True)
    parser.add_argument("--scenario", required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work) / "out"
        run = subprocess.run(
            [options.engine, "run", options.scenario, "-o", folder, "--threads", "1", "--quiet", "--set", CELLS],
            capture_output=True, text=True, timeout=300,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (LIMIT, LIMIT)))
        expect(run.returncode == 1, "status 1", run)
        expect("there is no more memory" in run.stderr and "take coarser cells" in run.stderr, "a remedy", run)
        expect("bad_alloc" not in run.stderr, "no name out of C++", run)
        expect(not folder.exists(), "no folder", run)
        if free_memory() < NEED:
            expect("warning: the run needs about" in run.stderr, "a warning before it begins", run)


main()

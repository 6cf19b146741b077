#!/usr/bin/env python3
"""full_disk_test.py --engine E --scenario S: what a run leaves where it cannot write.

Full disks are small tmpfs mounts of a mount namespace of our own; where the machine gives none
(status 77: skipped), the limit on the size of files stands for them."""

import argparse
import json
import os
import pathlib
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
NAMESPACE = "DUST_IN_NAMESPACE"


class Bench:
    def __init__(self, options):
        self.options = options
        self.whole = None
        self.series = None

    def engine(self, folder, *more, limit=None):
        def before():
            if limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        return subprocess.run(
            [self.options.engine, "run", self.options.scenario, "-o", folder, "--threads", "1",
             "--quiet", *more], capture_output=True, text=True, preexec_fn=before, timeout=60)

    def reference(self, folder):
        run = self.engine(folder)
        expect(run.returncode == 0, "the whole run", run)
        self.whole = digest(folder)
        self.series = (folder / "series.csv").read_text()
        return sum(f.stat().st_size for f in folder.rglob("*") if f.is_file())


def digest(folder):
    return json.loads((folder / "summary.json").read_text())["state_sha256"]


def expect(is_true, what, run):
    if is_true:
        return
    print(f"FAILED: {what}\nstatus {run.returncode}\n{run.stdout}{run.stderr}")
    sys.exit(1)


def check_message(run, folder, what, remedy):
    """Status 1 and one sentence with the path and the remedy."""
    lines = run.stderr.splitlines()
    expect(run.returncode == 1, f"{what}: status 1", run)
    expect(len(lines) == 1, f"{what}: one sentence", run)
    expect(lines[0].startswith("error: ") and str(folder) in lines[0], f"{what}: names the path", run)
    expect(remedy in lines[0], f"{what}: names a remedy", run)


def check_goes_on(bench, folder, what):
    """From the last good checkpoint to the same bits; from the start where there is none."""
    has_checkpoint = (folder / "checkpoint.h5").exists()
    run = bench.engine(folder, "--resume" if has_checkpoint else "--force")
    expect(run.returncode == 0, f"{what}: goes on once there is room", run)
    expect(digest(folder) == bench.whole, f"{what}: the bits of the whole run", run)
    expect((folder / "series.csv").read_text() == bench.series, f"{what}: the series of the whole run", run)
    expect(not list(folder.rglob("*.part")), f"{what}: nothing half-written stays", run)
    return has_checkpoint


def full_disks(bench, levels, work):
    bytes_needed = bench.reference(work / "whole")
    # From one page to nearly all; small disks, where each file may be the one, more often.
    draw = random.Random(2024).random
    sizes = [1 + int(draw() ** 3 * bytes_needed / 4096) for _ in range(levels)]
    disk = work / "disk"
    disk.mkdir()
    resumed = 0
    failed = 0
    for pages in sizes:
        what = f"a disk of {4 * pages} KiB"
        mount("-t", "tmpfs", "-o", f"size={4 * pages}k", "none", disk)
        folder = disk / "run"
        run = bench.engine(folder)
        if run.returncode != 0:
            failed += 1
            check_message(run, folder, what, "make room on that disk")
            mount("-o", "remount,size=1G", disk)
            resumed += check_goes_on(bench, folder, what)
        subprocess.run(["umount", disk], check=True)
    print(f"{levels} fill levels: {failed} runs met a full disk, {resumed} of them went on from a "
          "checkpoint")
    expect(0 < resumed < failed > levels // 2, "the levels met the run, with checkpoint and without", run)


def mount(*arguments):
    subprocess.run(["mount", *arguments], check=True)


def read_only(bench, work):
    disk = work / "read_only"
    disk.mkdir()
    mount("-t", "tmpfs", "none", disk)
    run = bench.engine(disk / "run", "--set", "time.end=10 ms")
    expect(run.returncode == 0, "the first part", run)
    mount("-o", "remount,ro", disk)
    check_message(bench.engine(disk / "run", "--resume"), disk, "a read-only disk, resumed",
                  "name a folder that you may write to with -o")
    check_message(bench.engine(disk / "other"), disk, "a read-only disk",
                  "name a folder that you may write to with -o")
    subprocess.run(["umount", disk], check=True)


def size_limits(bench, work):
    """The smallest limit forbids all but small text, the largest the checkpoint alone."""
    bench.reference(work / "limits")
    for limit in (1000, 5000, 20000, 60000, 200000, 1000000):
        folder = work / f"limit{limit}"
        run = bench.engine(folder, limit=limit)
        check_message(run, folder, f"files of {limit} bytes", "ulimit -f")
        check_goes_on(bench, folder, f"files of {limit} bytes")


def vanished_folder(bench, work):
    folder = work / "gone"
    command = [bench.options.engine, "run", bench.options.scenario, "-o", folder, "--threads", "1",
               "--quiet", "--set", "time.end=10 s"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    while not (folder / "frames" / "000002.h5").exists():
        time.sleep(0.005)
    moved = work / "moved"
    folder.rename(moved)
    process.returncode = process.wait(timeout=60)
    process.stdout, process.stderr = "", process.stderr.read()
    check_message(process, folder, "a folder that vanishes", "has it been moved or removed?")
    expect("--resume -o and its new place" in process.stderr, "a folder that vanishes: may have been moved", process)
    run = bench.engine(moved, "--resume", "--set", "time.end=12 ms")
    expect(run.returncode == 0, "a folder that was moved goes on in its new place", run)


def has_namespace():
    if os.environ.get(NAMESPACE):
        return True
    how = ["unshare", "-m"] if os.geteuid() == 0 else ["unshare", "-rm"]
    probe = subprocess.run([*how, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True)
    if probe.returncode != 0:
        return False
    os.environ[NAMESPACE] = "1"
    os.execvp(how[0], [*how, sys.executable, *sys.argv])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--engine", required=True)
    parser.add_argument("--scenario", required=True)
    parser.add_argument("--levels", type=int, default=0, help="fill levels of a full disk; 0: limits")
    options = parser.parse_args()
    if options.levels > 0 and (shutil.which("unshare") is None or not has_namespace()):
        print("no mount namespace on this machine: full disks cannot be made")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="dust-disk-") as folder:
        work = pathlib.Path(folder)
        bench = Bench(options)
        if options.levels > 0:
            full_disks(bench, options.levels, work)
            read_only(bench, work)
        else:
            size_limits(bench, work)
            vanished_folder(bench, work)


if __name__ == "__main__":
    main()

#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The page docs/how_to/run_a_study.md to the letter: its study is checked as it stands, as that of
run_on_a_cluster.md, and its Snakefile drives runs from outside.

    outside_test.py ENGINE SOURCE

Exit status 77 (skipped) where there is no snakemake: it is no dependency of the project
(apt-get install snakemake)."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ENGINE, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
PAGE = (SOURCE / "docs/how_to/run_a_study.md").read_text()
CLUSTER_PAGE = (SOURCE / "docs/how_to/run_on_a_cluster.md").read_text()


def check(condition, text):
    if not condition:
        sys.exit("FAILED: " + text)


def block_with(text, page=PAGE):
    for block in re.findall(r"```[a-z]*\n(.*?)```", page, flags=re.S):
        if text in block:
            return block
    sys.exit(f"FAILED: the page has no block with {text!r}")


def run(command, folder):
    environment = {**os.environ, "PATH": f"{ENGINE.parent}:{os.environ['PATH']}"}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    check(done.returncode == 0, f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def check_studies(folder):
    """Both studies of the page, beside the shipped bases."""
    shutil.copytree(SOURCE / "scenarios", folder / "scenarios")
    for name, text in (("my_study.yaml", block_with("replicates: 2")), ("calibration.yaml", block_with("calibrate:"))):
        (folder / "scenarios/studies" / name).write_text(text)
        told = run(["engine", "study", name, "--dry-run"], folder / "scenarios/studies")
        check("16 points" in told or "at most 30 runs" in told, f"{name}: {told}")
        check(" 1 threads" not in told, f"{name}: {told}")
    (folder / "speeds.yaml").write_text(block_with("points_per_job", CLUSTER_PAGE))
    told = run(["engine", "study", "speeds.yaml", "--dry-run"], folder)
    check("12 points" in told, f"the study of the cluster's page: {told}")


def drive_with_snakemake(folder):
    (folder / "Snakefile").write_text(block_with("# Snakefile"))
    # Any scenario with a belt will do; this one is small, and cut short.
    (folder / "transfer_point.yaml").write_text(
        f"include: {SOURCE}/tests/scenario/small_transfer.yaml\ntime: {{end: 0.01 s}}\n")
    run(["snakemake", "--cores", "2", "--quiet"], folder)
    for speed in ("0.2", "0.4", "0.8"):
        summary = json.loads((folder / f"runs/{speed}/summary.json").read_text())
        check(summary["status"] == "finished", f"the run at {speed} m/s is {summary['status']}")
        resolved = (folder / f"runs/{speed}/scenario.yaml").read_text()
        check(re.search(rf"speed: {speed}\b", resolved), f"{speed} m/s did not reach the run")
    # Nothing is left to do: the files are the proof.
    again = run(["snakemake", "--cores", "2", "--dry-run"], folder)
    check("Nothing to be done" in again, again)


def main():
    with tempfile.TemporaryDirectory() as folder:
        check_studies(pathlib.Path(folder))
    if not shutil.which("snakemake"):
        print("skipped: no snakemake on this machine (apt-get install snakemake)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        drive_with_snakemake(pathlib.Path(folder))


main()

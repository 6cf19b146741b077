#!/usr/bin/env python3
"""`engine study --launcher slurm` on a real cluster (tests/slurm/cluster).

usage: study_test.py ENGINE SOURCE SLURM_CONF
"""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

ENGINE, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
if not pathlib.Path(sys.argv[3]).exists():
    print("skipped: there is no cluster; 'tests/slurm/cluster install' brings Debian's packages")
    sys.exit(77)
os.environ["SLURM_CONF"] = sys.argv[3]
BASE = SOURCE / "tests/study/drop.yaml"


def engine(*arguments):
    return subprocess.run([ENGINE, *map(str, arguments)], text=True, capture_output=True)


def table(folder):
    """study.csv without times, which differ from run to run."""
    with open(folder / "study.csv", newline="") as file:
        return [{k: v for k, v in row.items() if k != "wall_s [s]"} for row in csv.DictReader(file)]


class OnSlurm(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)

    def write(self, text):
        study = self.folder / "study.yaml"
        study.write_text(f"base: {BASE}\n" + text)
        return study

    def test_a_job_array_shall_give_the_table_of_local_runs(self):
        study = SOURCE / "tests/study/drop_study.yaml"
        local = engine("study", study, "-o", self.folder / "local", "--quiet")
        self.assertEqual(local.returncode, 0, local.stderr)
        remote = engine("study", study, "-o", self.folder / "remote", "--launcher", "slurm")
        self.assertEqual(remote.returncode, 0, remote.stderr)
        self.assertEqual(table(self.folder / "remote"), table(self.folder / "local"))
        self.assertEqual(remote.stdout.count("]"), remote.stdout.count("["))
        self.assertIn("[8/8]", remote.stdout)

    def test_a_failing_point_shall_be_gathered_with_its_reason(self):
        study = self.write("set: {emitters.seed.enabled: true}\n"
                           "vary: {bodies.obstacle.enabled: [true, false]}\n"
                           "measure: {emitted: particles.emitted}\n")
        run = engine("study", study, "-o", self.folder / "out", "--launcher", "slurm")
        self.assertEqual(run.returncode, 1, run.stderr)
        rows = table(self.folder / "out")
        self.assertEqual([row["status"] for row in rows], ["failed", "finished"])
        self.assertIn("overlaps 'obstacle'", rows[0]["reason"])

    def start_long_study(self):
        study = self.write("set: {time.end: 2 s, time.output_every: 100 ms}\nreplicates: 2\n"
                           "measure: {emitted: particles.emitted}\n")
        out = self.folder / "out"
        process = subprocess.Popen([ENGINE, "study", study, "-o", out, "--launcher", "slurm"],
                                   text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        for _ in range(600):
            if list(out.glob("points/*/checkpoint.h5")):
                break
            time.sleep(0.1)
        return study, out, process

    def test_a_task_that_is_cut_off_shall_be_submitted_again_and_go_on(self):
        study, out, process = self.start_long_study()
        job = (out / "slurm/job").read_text().strip()
        subprocess.run(["scancel", "--batch", "--signal=TERM", f"{job}_0"], check=True)
        _, told = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, told)
        self.assertNotEqual((out / "slurm/job").read_text().strip(), job)
        self.assertEqual([row["status"] for row in table(out)], ["finished", "finished"])
        logs = "".join((out / f"points/{row['hash']}/run.log").read_text() for row in table(out))
        self.assertIn("resumed at", logs)
        whole = engine("study", study, "-o", self.folder / "local", "--quiet")
        self.assertEqual(whole.returncode, 0, whole.stderr)
        self.assertEqual(table(out), table(self.folder / "local"))

    def test_an_interrupted_study_shall_cancel_its_jobs_and_a_killed_one_find_them_again(self):
        study, out, process = self.start_long_study()
        process.kill()
        process.communicate()
        resumed = engine("study", study, "-o", out, "--launcher", "slurm", "--resume")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertEqual([row["status"] for row in table(out)], ["finished", "finished"])

        self.setUp()
        study, out, process = self.start_long_study()
        process.terminate()
        process.communicate(timeout=120)
        self.assertEqual(process.returncode, 143)
        queue = subprocess.run(["squeue", "--noheader"], text=True, capture_output=True).stdout
        self.assertEqual(queue.strip(), "")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

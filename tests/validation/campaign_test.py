#!/usr/bin/env python3
"""A campaign with a stand-in for the engine that counts to its end, leaves a checkpoint when it is told to stop and goes on
from it."""

import csv
import fcntl
import pathlib
import stat
import subprocess
import sys
import tempfile
import time
import unittest

import package

import campaign_list
import cases
import commands
import runs

TOOL = package.ROOT / "tools/validation/campaign"
ENGINE = """#!{python}
import json, pathlib, signal, sys, time
args = sys.argv[1:]
if args[0] == "check":
    print(json.dumps({{"core_s": 36.0}}))
    sys.exit(0)
folder = pathlib.Path(args[args.index("-o") + 1])
checkpoint, summary = folder / "checkpoint.h5", folder / "summary.json"
assert ("--resume" in args) == checkpoint.exists(), args
told = []
signal.signal(signal.SIGTERM, lambda *_: told.append(1))
count = int(checkpoint.read_text()) if checkpoint.exists() else 0
while count < {length} and not told:
    count += 1
    time.sleep(0.01)
    checkpoint.write_text(str(count))
with open(folder / "starts", "a") as file:
    file.write(f"{{count}}\\n")
if "copies_of_rare" in " ".join(args):
    sys.exit(1)
status = "interrupted" if told else "finished"
summary.write_text(json.dumps({{"status": status, "simulated_s": count / 100, "cpu_s": 18.0, "state_sha256": "0" * 64,
                               "sensors": {{}}}}))
sys.exit(143 if told else 0)
"""


class Campaign(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.runs = pathlib.Path(self.folder.name) / "runs"
        self.list = pathlib.Path(self.folder.name) / "list"

    def engine(self, length):
        file = pathlib.Path(self.folder.name) / "engine"
        file.write_text(ENGINE.format(python=sys.executable, length=length))
        file.chmod(file.stat().st_mode | stat.S_IXUSR)
        return file

    def campaign(self, what, *more):
        done = subprocess.run([sys.executable, TOOL, what, "--runs", self.runs, "--list", self.list, "--commit", "abc1234", "--nice", "0",
                               "--engine", pathlib.Path(self.folder.name) / "engine", *more], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def ended(self):
        file = self.runs / "campaign.csv"
        if not file.exists():
            return {}
        with open(file, newline="") as lines:
            return {row["run"]: row for row in csv.DictReader(lines)}

    def wait_for(self, what):
        until = time.time() + 60
        while not what():
            self.assertLess(time.time(), until, "it did not happen")
            time.sleep(0.02)

    def test_stopped_and_begun_again_it_goes_on_from_the_checkpoint(self):
        self.engine(length=300)
        self.list.write_text("janssen_rough  # a comment\n")
        self.campaign("start")
        checkpoint = self.runs / "janssen_rough" / "checkpoint.h5"
        self.wait_for(lambda: checkpoint.exists() and checkpoint.read_text() > "0")
        # Another process that wants the same run leaves it alone.
        run = runs.Run(cases.all_plans()["janssen_rough"], checkpoint.parent)
        self.assertIsNone(run.start(runs.Engine("engine", 1, "abc1234")))
        self.campaign("stop")
        reached = int(checkpoint.read_text())
        self.assertLess(reached, 300)
        self.assertEqual(self.ended(), {})
        self.assertIn("broken off", self.campaign("left"))
        self.campaign("start", "--foreground")
        self.assertEqual((self.runs / "janssen_rough" / "starts").read_text(), f"{reached}\n300\n")
        row = self.ended()["janssen_rough"]
        self.assertEqual((row["status"], row["commits"]), ("finished", "abc1234"))

    def test_two_jobs_run_side_by_side_and_stop_together(self):
        self.engine(length=500)
        names = ("janssen_rough", "janssen_smooth", "beverloo_8")
        self.list.write_text("\n".join(names))
        self.campaign("start", "--jobs", "2")
        checkpoints = [self.runs / name / "checkpoint.h5" for name in names]
        self.wait_for(lambda: all(c.exists() and c.read_text() > "0" for c in checkpoints[:2]))
        self.assertFalse(checkpoints[2].exists())
        told = self.campaign("left").splitlines()
        self.assertEqual([line.split()[0] for line in told[:3]], ["runs", "runs", "left"])
        self.campaign("stop")
        self.assertEqual(self.ended(), {})
        self.assertEqual([(c.parent / "starts").read_text() for c in checkpoints[:2]], [f"{c.read_text()}\n" for c in checkpoints[:2]])
        self.engine(length=1)
        self.campaign("start", "--foreground", "--jobs", "2")
        self.assertEqual({row["status"] for row in self.ended().values()}, {"finished"})
        self.assertEqual(set(self.ended()), set(names))

    def test_what_fails_is_written_down_and_the_next_one_runs(self):
        self.engine(length=1)
        self.list.write_text("rare_copies_*\njanssen_*\n")
        self.campaign("start", "--foreground")
        self.assertEqual([r["status"] for r in self.ended().values()], 3 * ["ended with 1"] + 2 * ["finished"])
        # Half of what was told: what is left is told by that pace.
        self.list.write_text("janssen_*\nbeverloo_8\n")
        self.assertIn("1 left, about 0.0 h of one core (0.50 of what", self.campaign("left"))

    def test_what_another_command_ran_under_that_name_is_put_aside_and_run_anew(self):
        self.engine(length=1)
        self.list.write_text("janssen_rough\n")
        self.campaign("start", "--foreground")
        note = self.runs / "janssen_rough" / "validation.json"
        plan = cases.all_plans()["janssen_rough"]
        note.write_text(note.read_text().replace("engine run ", "engine run --set seed=7 ", 1))
        self.assertFalse(runs.Run(plan, note.parent).is_finished())
        self.assertIn("1 left", self.campaign("left"))
        self.campaign("start", "--foreground")
        self.assertIn("0 left", self.campaign("left"))
        self.assertTrue(runs.Run(plan, note.parent).is_finished())
        self.assertIn("seed=7", (self.runs / "janssen_rough.before_1" / "validation.json").read_text())

    def test_what_another_command_still_runs_under_that_name_is_left_where_it_is(self):
        plan = cases.all_plans()["janssen_rough"]
        folder = self.runs / plan.name
        folder.mkdir(parents=True)
        (folder / "validation.json").write_text('{"command": "engine run --set seed=7 scenarios/janssen.yaml"}')
        with open(folder / "lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assertIsNone(runs.Run(plan, folder).start(None))
        self.assertEqual([f.name for f in self.runs.iterdir()], [plan.name])

    def test_a_run_of_two_names_is_made_once(self):
        self.engine(length=1)
        two = ("settling_a1_box_w_d_10", "settling_a1_place_w_d_10_middle")
        self.assertEqual(len({cases.all_plans()[name].same() for name in two}), 1)
        self.list.write_text("\n".join(two))
        self.campaign("start", "--foreground")
        self.assertEqual(list(self.ended()), [two[0]])
        self.list.write_text(two[1])
        self.assertIn("0 left", self.campaign("left"))
        # Whoever asks for the other finds it.
        both = runs.Runs([cases.all_plans()[name] for name in two], self.runs, None)
        self.assertEqual({both[name].folder.name for name in two}, {two[0]})

    def test_what_the_scenario_says_already_makes_no_other_run(self):
        def same(*settings, scenario="transfer_point.yaml"):
            return runs.Plan("any", scenario, dict(settings)).same()
        self.assertEqual(same(("bodies.belt.speed", "0.8 m/s"), ("time.end", "1 s")), same(("time.end", "1 s")))
        self.assertEqual(same(("emitters.feed.min", '[26, 1.5, "220 mm"]')), same())
        self.assertEqual(same(("interactions[1].rolling.friction", "0.5")), same())
        # By what it includes, unless it says otherwise itself.
        late = "thesis/transfer_point_4s.yaml"
        self.assertEqual(same(("bodies.belt.speed", "0.8 m/s"), scenario=late), same(scenario=late))
        self.assertNotEqual(same(("time.end", "0.7 s"), scenario=late), same(scenario=late))
        for other in (("bodies.belt.speed", "0.6 m/s"), ("frames.conveyor.angle", "3.5 deg"), ("seed", "1"), ("fluid", "none")):
            self.assertNotEqual(same(other), same())
        # What the file itself says in place of a block takes that of the included one away.
        with tempfile.TemporaryDirectory() as folder:
            below, above = (pathlib.Path(folder) / name for name in ("below.yaml", "above.yaml"))
            below.write_text("fluid: {density: 1.2}\nlist: [1, 2]\n")
            above.write_text("include: below.yaml\nfluid: none\nlist: [3]\n")
            self.assertEqual([commands.value_in(below, "fluid.density"), commands.value_in(above, "fluid.density")], [1.2, None])
            self.assertEqual([commands.value_in(below, "list[1]"), commands.value_in(above, "list[1]")], [2, None])
        # Of a block that another setting replaces, the scenario says nothing any more.
        air = ("domain.boundaries.left.air", '{"model": "total_pressure"}')
        self.assertNotEqual(same(air, ("domain.boundaries.left.air.pressure", "0 Pa")), same(air))


class Budget(unittest.TestCase):
    def test_it_reaches_as_far_in_the_order_as_its_hours_do(self):
        hours = {"wide": 30.0, "narrow_1": 20.0, "narrow_2": 20.0, "listed_nowhere": 1.0, "cost_unknown": None}
        order = ["cost_unknown", "narrow_*", "wide"]
        self.assertEqual(campaign_list.within_budget(hours, 0.0, order), ["cost_unknown", "narrow_1", "narrow_2", "wide", "listed_nowhere"])
        self.assertEqual(campaign_list.within_budget(hours, campaign_list.BUDGET_HOURS - 20.0, order), ["cost_unknown", "narrow_1"])

    def test_every_run_of_the_thesis_has_its_place_in_the_order(self):
        order = campaign_list.patterns()
        lost = [plan.name for plan in cases.load("thesis").plans() if campaign_list.place_of(plan.name, order) == len(order)]
        self.assertEqual(lost, [])


if __name__ == "__main__":
    unittest.main()

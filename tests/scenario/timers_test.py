#!/usr/bin/env python3
"""timers_test.py ENGINE SCENARIO: the groups of timers in a run's summary.json, as tools/dev/timers.py reads them."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/dev"))
import timers  # noqa: E402

ENGINE, SCENARIO = sys.argv.pop(1), sys.argv.pop(1)


class Groups(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([ENGINE, "run", SCENARIO, "--set", "time.end=2 ms", "--quiet", "-o", f"{folder}/out"], check=True)
            cls.summary = json.loads(pathlib.Path(folder, "out/summary.json").read_text())

    def test_every_name_is_a_timer(self):
        for group, names in self.summary["timer_groups"].items():
            self.assertTrue(names, group)
            self.assertLessEqual(set(names), set(self.summary["timers_s"]), group)

    def test_the_fluids_force_is_inside_the_cycle_and_not_of_the_particles(self):
        groups = self.summary["timer_groups"]
        self.assertEqual(set(groups["dem_cycle"]) - set(groups["particles"]), {"drag"})

    def test_what_the_particles_cost_is_part_of_their_cycle(self):
        spent = timers.of_particles(self.summary)
        self.assertGreater(spent, 0.0)
        self.assertLess(spent, 1.1 * self.summary["timers_s"]["dem_cycle"])

    def test_timers_that_are_not_nested_fill_the_run(self):
        outer = [s for name, s in self.summary["timers_s"].items() if name not in timers.nested(self.summary)]
        self.assertLess(sum(outer), 1.1 * self.summary["wall_s"])


unittest.main()

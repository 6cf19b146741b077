#!/usr/bin/env python3
"""Rules of tools/validation: verdicts, bands, stale pages, points of studies, cases."""

import json
import math
import pathlib
import re
import tempfile
import unittest
import unittest.mock

import package  # noqa: F401

import bed
import cases
import chart
import effects
import figures
import index
import kept
import page
import runs
import stale
import study_points
from cases import beverloo, dosta_drum
from thesis.row import Row, Sign, difference


def finished_run(folder, name, sensors, note=None):
    """A run as the engine leaves it, as far as the pages read it."""
    run = runs.Run(runs.Plan(name, "verification/box.yaml"), pathlib.Path(folder) / name)
    run.folder.mkdir()
    figures = {s: {f: {"value": v, "unit": "1", "uncertainty": e} for f, (v, e) in figs.items()} for s, figs in sensors.items()}
    (run.folder / "summary.json").write_text(json.dumps({
        "status": "finished", "sensors": figures, "particles": {"max": 1}, "simulated_s": 1.0, "dem_step_s": 1e-5,
        "fluid_steps": 0, "particle_steps": 1.0, "cpu_s": 1.0, "state_sha256": "abcdef0123456789"}))
    (run.folder / "scenario.yaml").write_text("materials:\n  sand: {young_modulus: 5e6}\n")
    if note:
        (run.folder / "validation.json").write_text(json.dumps(note))
    return run


class AnyFigures(dict):
    """A row of series.csv that has every column; time and what flows grow."""

    def __missing__(self, column):
        return 50.0 * self["time [s]"] + 1.0


class AnyRun(runs.Run):
    """A finished run whose sensors have every figure."""

    summary = {"status": "finished", "sensors": {}, "cpu_s": 3600.0, "mass_kg": {"in_domain": 1.0}, "particles": {"max": 1},
               "simulated_s": 1.0, "dem_step_s": 1e-5, "fluid_steps": 0, "particle_steps": 1.0, "state_sha256": 64 * "0",
               "size_classes": [{"hertz_time_s": 1e-4}],
               "dust_rates": {"left/right/rate": {"value": 1.0, "uncertainty": 0.01}}}

    def figure(self, sensor, name):
        return 1.0 + 1e-3 * len(self.name), 0.01

    def series(self):
        return [AnyFigures({"time [s]": 0.01 * n, "fall/velocity [m/s]": 0.1, "outlet/number [1]": 1000.0 * n,
                             "drop/superficial_velocity [m/s]": 0.00556 * (n % 101)})
                for n in range(730)]

    def stiffness(self):
        return "sand 5 MPa"


class AllRuns(runs.Runs):
    def __init__(self, case):
        super().__init__(case.plans(), "/nowhere", None)
        self._runs = {plan.name: AnyRun(plan, "/nowhere") for plan in case.plans()}
        if hasattr(case, "later"):
            self._runs |= {plan.name: AnyRun(plan, "/nowhere") for plan in case.later(self)}


class KeptPages(unittest.TestCase):
    """With --keep a page goes on saying what it says of runs whose folders are gone, and no more."""

    def written(self, folder, values, before):
        """The page of two runs, of which those in `values` have a folder, as lines."""
        plans = [runs.Plan(name, "verification/box.yaml", {"seed": name[-1]}) for name in ("run_1", "run_2")]
        for name, value in values.items():
            finished_run(folder, name, {"s": {"f": (value, None)}}, {"commits": [f"of_{name}"], "date": "2026-01-02", "bits": [{"box": name}]})
        found = runs.Runs(plans, folder, None, before)
        text = page.Page("case", before)
        for plan in plans:
            text.add(f"figure of {plan.name}", found[plan.name].figure("s", "f"), "1", 0.5, 1.5)
        return text.text("Case", found, "how")

    def test_rows_runs_and_commands_stay_until_they_are_made_anew(self):
        with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
            file = pathlib.Path(first) / "case.md"
            file.write_text(self.written(first, {"run_1": 1.25}, kept.Kept()))
            text = self.written(second, {"run_2": 1.0}, kept.Kept(file))
            for part in ("| figure of run_1 | 1.25 |", "| figure of run_2 | 1 |", "| run_1 | of_run_1 |", "| run_2 | of_run_2 |",
                         "commit of_run_1, of_run_2", "--set seed=1", "<!-- bits box=run_1 -->", "<!-- bits box=run_2 -->"):
                self.assertIn(part, text)
            self.assertIn("## What has not been run\n\nNothing.", text)
            # Without --keep it is not there, and a run that is made again says what it gave.
            self.assertIn("| figure of run_1 | not run to its end |", self.written(second, {}, kept.Kept()))
            file.write_text(text)
            with tempfile.TemporaryDirectory() as third:
                again = self.written(third, {"run_1": 1.1}, kept.Kept(file))
                self.assertIn("| figure of run_1 | 1.1 |", again)
                self.assertEqual(1, again.count("| run_1 |"))

    def test_a_kept_run_that_is_made_by_another_command_today_is_run_anew(self):
        with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
            file = pathlib.Path(first) / "case.md"
            file.write_text(self.written(first, {"run_1": 1.25, "run_2": 1.0}, kept.Kept()))
            before = kept.Kept(file)
            plans = [runs.Plan("run_1", "verification/box.yaml", {"seed": "7"}), runs.Plan("run_2", "verification/box.yaml", {"seed": "2"})]
            found = runs.Runs(plans, second, None, before)
            self.assertEqual([found.is_done(run) for run in found], [False, True])
            before.only(list(found))
            sheet = page.Page("case", before)
            sheet.add("figure of run_1", found["run_1"].figure("s", "f"), "1", 0.5, 1.5)
            text = sheet.text("Case", found, "how")
            self.assertIn("Made otherwise today and not yet anew: run_1.", text)
            self.assertNotIn("| run_1 |", text)

    def test_a_kept_run_whose_engine_the_page_did_not_name_is_of_an_unknown_one(self):
        with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
            file = pathlib.Path(first) / "case.md"
            page_of_old = self.written(first, {"run_1": 1.25}, kept.Kept())
            file.write_text(re.sub(r"<!-- bits .*-->\n?", "", page_of_old))
            text = self.written(second, {"run_2": 1.0}, kept.Kept(file))
            self.assertEqual([None, {"box": "run_2"}], stale.bits_of(text))

    def test_kept_runs_are_of_the_bits_of_their_commits(self):
        def bits_at(commit):
            return {"box": commit} if commit.startswith("of_") else {}

        with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second, unittest.mock.patch("page.bits_at", bits_at):
            file = pathlib.Path(first) / "case.md"
            # A line of a run that has been made anew since, with those that stay.
            file.write_text(self.written(first, {"run_1": 1.25}, kept.Kept()) + "<!-- bits box=older -->\n")
            text = self.written(second, {"run_2": 1.0}, kept.Kept(file))
            self.assertEqual([{"box": "of_run_1"}, {"box": "run_2"}], stale.bits_of(text))
            # Where the history does not know a commit, all that the page had.
            file.write_text(file.read_text().replace("of_run_1", "?"))
            text = self.written(second, {}, kept.Kept(file))
            self.assertEqual([{"box": "run_1"}, {"box": "older"}, {"box": "run_2"}], stale.bits_of(text))

    def test_pictures_of_runs_that_are_gone_stay_and_new_ones_take_other_files(self):
        drawn = []
        with tempfile.TemporaryDirectory() as folder, \
                unittest.mock.patch("chart.draw", lambda file, title, *_: drawn.append((file.name, title))):
            file = pathlib.Path(folder) / "case.md"
            file.write_text("![Old](pictures/case_1.svg)\n\n## Runs\n")
            sheet = page.Page("case", kept.Kept(file))
            sheet.chart("New", "x", "y", [chart.Curve("ours", [1], [1])], "text")
            sheet.chart("Old", "x", "y", [chart.Curve("ours", [], [])], "text")
            sheet.chart("None", "x", "y", [], "text")
            text = sheet.text("Case", runs.Runs([], folder, None), "how")
        self.assertEqual([("case_2.svg", "New")], drawn)
        self.assertEqual(["![New](pictures/case_2.svg)", "![Old](pictures/case_1.svg)"],
                         [line for line in text.splitlines() if line.startswith("![")])

    def test_a_chart_of_the_rows_keeps_what_the_page_told(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "case.md"
            before = page.Page("case")
            told = [(1.5, 0.25), (-2e-06, None), None, (12345.0, 3.0)]
            for n, ours in enumerate(told):
                before.add(f"figure {n}", ours, "1", why="none", unit="mm" if n else "")
            file.write_text(before.text("Case", runs.Runs([], folder, None), "how"))
            sheet = page.Page("case", kept.Kept(file))
            self.assertEqual(told, [sheet.add(f"figure {n}", None, "1", why="none") for n in range(4)])
            self.assertEqual((7.0, None), sheet.add("figure 4", (7.0, None), "1", why="none"))

    def test_a_change_is_told_between_a_run_that_is_gone_and_one_of_today(self):
        plans = {level: runs.Plan(f"run_{level}", "verification/box.yaml", {"seed": level}) for level in "12"}
        with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
            page_file, read_off = pathlib.Path(first) / "case.md", pathlib.Path(first) / "figures" / "case.csv"
            noted = figures.Figures()
            finished_run(first, "run_1", {"s": {"f": (1.25, 0.5), "g": (1 / 3, None)}})
            before = runs.Runs(plans.values(), first, None, kept.Kept(), noted)
            for name in "fg":
                before["run_1"].figure("s", name)
            page_file.write_text(page.Page("case").text("Case", before, "how"))
            noted.write(read_off)

            finished_run(second, "run_2", {"s": {"f": (2.0, None)}})
            after = runs.Runs(plans.values(), second, None, kept.Kept(page_file), figures.Figures(read_off))
            self.assertEqual([(1.25, 0.5), (1 / 3, None), (2.0, None)],
                             [after["run_1"].figure("s", "f"), after["run_1"].figure("s", "g"), after["run_2"].figure("s", "f")])
            # Not of a run that the page does not have, and not of one that would be made with another command today.
            other = runs.Plan("run_1", "verification/box.yaml", {"seed": "3"})
            for plan, page_before in ((plans["1"], kept.Kept()), (other, kept.Kept(page_file))):
                gone = runs.Runs([plan], second, None, page_before, figures.Figures(read_off))
                self.assertIsNone(gone["run_1"].figure("s", "f"))

    def test_figures_of_runs_that_a_page_has_no_more_are_forgotten(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "case.csv"
            noted = figures.Figures()
            noted.note("old", "s", "f", (1.0, None))
            noted.write(file)
            self.assertTrue(file.exists())
            noted.only({"new"})
            noted.write(file)
            self.assertFalse(file.exists())

    def test_what_was_read_off_an_earlier_run_of_the_same_name_is_forgotten(self):
        with tempfile.TemporaryDirectory() as folder:
            finished_run(folder, "anew", {})
            noted = figures.Figures()
            for run in ("anew", "gone"):
                noted.note(run, "s", "f", (1.0, None))
            runs.Runs([runs.Plan(run, "verification/box.yaml") for run in ("anew", "gone")], folder, None, figures=noted)
            self.assertEqual([None, (1.0, None)], [noted.of(run, "s", "f") for run in ("anew", "gone")])

    def test_a_row_that_was_open_is_not_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "case.md"
            file.write_text(self.written(folder, {}, kept.Kept()))
            self.assertIsNone(kept.Kept(file).row("figure of run_1"))


class ThesisRows(unittest.TestCase):
    def row(self, ours, **more):
        return Row("table", "what", ("run",), ours and (ours, None), measured=6.6, uncertainty=0.1, thesis=6.3, **more)

    def test_nearer_than_the_thesis_is_better(self):
        self.assertEqual(self.row(6.8).verdict(), "better")

    def test_within_the_uncertainty_beyond_the_thesis_is_as_good(self):
        self.assertEqual(self.row(6.21).verdict(), "as good")

    def test_beyond_that_is_worse_even_inside_the_band(self):
        row = self.row(7.05, limit=0.077)
        self.assertEqual(row.verdict(), "worse")
        self.assertIn("pass", row.band())

    def test_the_band_fails_by_the_measured_value(self):
        self.assertIn("FAIL", self.row(7.83, limit=0.077).band())

    def test_without_a_run_nothing_is_judged(self):
        row = self.row(None, limit=0.077)
        self.assertEqual((row.verdict(), row.band()), ("not run", "7.7 %"))

    def test_a_sign_counts_where_it_is_told_from_noise(self):
        def verdict(*change):
            return Sign("t", "w", (), effects.Change(*change)).verdict()
        self.assertEqual(verdict(1.0, 0.4), "as good")
        self.assertEqual(verdict(1.0, 0.6), "not told from noise")
        self.assertEqual(verdict(-1.0, 0.1), "worse")
        # Of two seeds a change must exceed 12.7 errors.
        self.assertEqual(verdict(1.0, 0.1, 1), "not told from noise")
        self.assertEqual(verdict(-1.0, 0.1, 1), "not told from noise")
        self.assertEqual(verdict(1.0, None, effects.FREE, 4, 2), "open: not steady")
        self.assertEqual(verdict(1.0), "as good")
        self.assertEqual(Sign("t", "w", ()).verdict(), "not run")

    def test_the_page_of_the_thesis_counts_the_undecided(self):
        rows = [Sign("t", "w", (), effects.Change(1.0, error)) for error in (0.1, 0.6, 0.7)]
        self.assertEqual({"as good": 1, "undecided": 2}, {kind: n for kind, n in cases.load("thesis").counts_of(rows).items() if n})

    def test_errors_of_a_difference_add_in_squares_and_where_one_is_unknown_so_is_the_other(self):
        known = difference((33.6, 0.003), (44.4, 0.004))
        self.assertAlmostEqual(known.size, 10.8)
        self.assertAlmostEqual(known.error, 0.005)
        self.assertIsNone(difference((33.6, 0.17), (44.4, None)).error)
        self.assertIsNone(difference((33.6, None), (44.4, 0.17)).error)


class Pages(unittest.TestCase):
    def test_a_figure_without_a_band_says_why(self):
        with self.assertRaises(ValueError):
            page.Page("x").add("a", 1.0, "2")

    def test_what_failed_and_what_has_not_been_run_is_listed(self):
        with tempfile.TemporaryDirectory() as folder:
            note = {"commits": ["abc1234"], "bits": [{"box": "0123"}, {}], "date": "2026-01-01"}
            done = finished_run(folder, "done", {}, note)
            missing = runs.Plan("missing", "verification/haff.yaml")
            all_of_them = runs.Runs([done.plan, missing], folder, None)
            sheet = page.Page("x")
            sheet.add("inside", 1.0, "1", 0.9, 1.1)
            sheet.add("outside", 2.0, "1", 0.9, 1.1)
            sheet.add("left", None, "1", 0.9, 1.1)
            text = sheet.text("Title", all_of_them, "how")
        self.assertIn("- outside: 2 (band 0.9 to 1.1)", text)
        self.assertNotIn("- inside", text)
        self.assertIn("- `engine run scenarios/verification/haff.yaml`", text)
        self.assertIn("Runs of commit abc1234, 2026-01-01", text)
        self.assertEqual(stale.bits_of(text), [{"box": "0123"}, None])


class Stale(unittest.TestCase):
    TEXT = "<!-- bits box=1 drum=2 -->\n"

    def test_the_same_bits_are_not_stale(self):
        self.assertEqual(stale.why(self.TEXT, ("box",), {"box": "1", "drum": "3"}), "")

    def test_other_bits_of_a_watched_case_are(self):
        self.assertIn("drum", stale.why(self.TEXT, ("box", "drum"), {"box": "1", "drum": "3"}))

    def test_a_case_that_was_not_recorded_then_is(self):
        self.assertIn("mixer", stale.why(self.TEXT, ("mixer",), {"mixer": "1"}))

    def test_one_run_of_an_older_engine_is_enough(self):
        self.assertTrue(stale.why(self.TEXT + "<!-- bits box=0 drum=2 -->\n", ("box",), {"box": "1"}))

    def test_a_page_that_says_nothing_is(self):
        self.assertTrue(stale.why("# A page\n", ("box",), {"box": "1"}))
        self.assertTrue(stale.why("<!-- bits unknown -->", ("box",), {"box": "1"}))

    def test_a_page_says_its_age_below_its_title(self):
        line = stale.MARK + " (2026-01-01: bits have changed in box).*"
        self.assertEqual(stale.said(stale.marked("# A page\n\nText.\n", line)), line)
        self.assertEqual(stale.said("# A page\n\nText.\n"), "")
        self.assertEqual(index.age_of(stale.marked("# A page\n\nText.\n" + self.TEXT, line)), "older")
        self.assertEqual(index.age_of("# A page\n\nText.\n" + self.TEXT), "today's bits")
        self.assertEqual(index.age_of("# A page\n\nText.\n"), "-")

    def test_a_page_is_marked_once_and_unmarked(self):
        once = stale.marked("# Title\n\ntext\n", stale.MARK + " (why).*")
        self.assertEqual(stale.marked(once, stale.MARK + " (more).*").count(stale.MARK), 1)
        self.assertEqual(stale.marked(once, ""), "# Title\n\ntext\n")

    def test_the_cost_of_a_page_is_what_its_runs_took(self):
        rows = ["| run | commit | CPU [s] | state |", "| --- | --- | --- | --- |", "| ran | abc1234 | 3600 | `1234` |",
                "| again | abc1234 | 7200 | `5678` |", "| under_another_name | abc1234 | 7200 | `5678` |", "| untold | abc1234 | - | `90ab` |"]
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "page.md"
            file.write_text("\n".join(["# Page", "", "| figure | 900 |", "", "## Runs", "", *rows]) + "\n")
            self.assertEqual(3.0, kept.Kept(file).hours())
            self.assertEqual(2.0, kept.Kept(file).hours(besides={"ran"}))

    def test_the_engine_tells_its_commit(self):
        self.assertEqual(runs.commit_in("engine 0.1.0\ncommit: abc1234, changed\n"), "abc1234+changes")
        self.assertEqual(runs.commit_in("engine 0.1.0\ncommit: abc1234\n"), "abc1234")
        self.assertIsNone(runs.commit_in("engine 0.1.0\n"))

    def test_an_engine_that_is_not_a_commit_claims_no_bits(self):
        self.assertEqual(runs.bits_at("abc1234+changes"), {})
        self.assertEqual(runs.bits_at("of no commit"), {})


class Points(unittest.TestCase):
    def test_axes_cases_and_zips_are_combined(self):
        text = {"set": {"a": "1"}, "cases": {"one": {}, "two": {"b": "2"}}, "vary": {"c": [0.2, "0.4 m/s"]},
                "zip": {"d": ["1", "2"], "e": ["x", "y"]}}
        found = study_points.points(text)
        self.assertEqual(len(found), 8)
        self.assertIn(("two 0.2 m/s 2", {"a": "1", "b": "2", "c": "0.2 m/s", "d": "2", "e": "y"}), found)

    def test_levels_are_spread_over_an_interval(self):
        self.assertEqual(study_points.levels_of({"from": 0.1, "to": 0.3, "count": 3}), [0.1, 0.2, 0.3])

    def test_replicates_have_seeds(self):
        found = study_points.points({"cases": {"base": {}}, "replicates": 2})
        self.assertEqual([settings["seed"] for _, settings in found], ["1", "2"])

    def test_a_change_is_the_mean_over_what_is_not_held(self):
        text = {"base": "../verification/box.yaml", "vary": {"a.b": [1, "2 m/s"], "seed": [1, 2]}, "measure": {"f": "sensors.s.f"}}
        values = {("1 m/s", "1"): 1.0, ("1 m/s", "2"): 3.0, ("2 m/s", "1"): 10.0, ("2 m/s", "2"): 4.0}
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch("study_points.read", lambda _: text):
            plans = dict(study_points.labelled("any"))
            for plan in plans.values():
                finished_run(folder, plan.name, {"s": {"f": (values[plan.settings["a.b"], plan.settings["seed"]], 0.5)}})
            found = runs.Runs(plans.values(), folder, None)
            def change(**more):
                return study_points.change(found, "any", {"output": "f", "input": "seed", **more})
            self.assertEqual(-2.0, change().size)
            held = change(at={"a.b": "1 m/s"})
            self.assertEqual(2.0, held.size)
            self.assertAlmostEqual(math.hypot(0.5, 0.5), held.error)
            self.assertEqual(-6.0, change(at={"a.b": "2 m/s"}).size)

    def test_the_error_of_replicates_is_the_scatter_of_their_changes(self):
        text = {"base": "../verification/box.yaml", "cases": {"a": {"x": 1}, "b": {"x": 2}}, "replicates": 3, "measure": {"f": "sensors.s.f"}}
        values = {"1": (1.0, 2.0, 3.0), "2": (12.0, 11.0, 13.0)}
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch("study_points.read", lambda _: text):
            plans = dict(study_points.labelled("any"))
            for plan in plans.values():
                # No sensor tells an error: it has seen too few grains.
                finished_run(folder, plan.name, {"s": {"f": (values[plan.settings["x"]][int(plan.settings["seed"]) - 1], None)}})
            found = runs.Runs(plans.values(), folder, None)
            change = study_points.change(found, "any", {"output": "f", "input": "case", "from": "a", "to": "b"})
            # The seeds change by 11, 9 and 10: a standard deviation of 1 over three.
            self.assertEqual((10.0, 2), (change.size, change.freedom))
            self.assertAlmostEqual(math.sqrt(1.0 / 3.0), change.error)

    def test_figures_that_are_not_steady_leave_a_sign_open(self):
        text = {"base": "../verification/box.yaml", "vary": {"a.b": [2, 1]}, "measure": {"f": {"quantity": "sensors.s.f", "unit": "mm"}}}
        over = {"output": "f", "input": "a.b", "then": "rises", "why": "so"}
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch("study_points.read", lambda _: text):
            plans = dict(study_points.labelled("any"))
            for plan in plans.values():
                finished_run(folder, plan.name, {"s": {"f": (1e-3 * float(plan.settings["a.b"]), 1e-5)}},
                             {"commits": ["abc1234"], "date": "2026-01-02"})
            noted, page_file = figures.Figures(), pathlib.Path(folder) / "any.md"

            def row(found):
                sheet = page.Page("any")
                study_points.add_sign(sheet, found, "any", over)
                return sheet.text("Any", found, "how")

            # From 1 to 2, in whatever order the study has them.
            self.assertIn("| f rises with a.b | 1 ± 0.014 mm | rises: so | sign, beyond 2 errors | pass |", row(runs.Runs(plans.values(), folder, None)))
            summary = pathlib.Path(folder) / plans["2"].name / "summary.json"
            told = json.loads(summary.read_text())
            told["sensors"]["s"]["f"] |= {"uncertainty": None, "no_error": "not steady"}
            summary.write_text(json.dumps(told))
            text_of_page = row(runs.Runs(plans.values(), folder, None, kept.Kept(), noted))
            wanted = "| f rises with a.b | 1 mm | rises: so | sign, steady | open: 1 of 2 points not steady |"
            self.assertIn(wanted, text_of_page)
            self.assertIn("## What is undecided\n\n- f rises with a.b: 1 mm: open: 1 of 2 points not steady\n", text_of_page)
            self.assertIn("## What has not been run\n\nNothing.", text_of_page)
            # What is kept of a run whose folder is gone says it, too.
            noted.write(pathlib.Path(folder) / "any.csv")
            page_file.write_text(text_of_page)
            gone = runs.Runs(plans.values(), "/nowhere", None, kept.Kept(page_file), figures.Figures(pathlib.Path(folder) / "any.csv"))
            self.assertIn(wanted, row(gone))

    def test_where_no_sensor_tells_an_error_the_changes_at_other_levels_do(self):
        text = {"base": "../verification/box.yaml", "vary": {"mu": [1, 2, 3], "mu_r": [0, 1]}, "measure": {"f": "sensors.s.f"}}
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch("study_points.read", lambda _: text):
            plans = dict(study_points.labelled("any"))
            for plan in plans.values():
                mu, rolling = float(plan.settings["mu"]), float(plan.settings["mu_r"])
                finished_run(folder, plan.name, {"s": {"f": (100.0 * mu + rolling * (9.0 + mu), None)}})
            found = runs.Runs(plans.values(), folder, None)
            over = {"output": "f", "input": "mu_r", "then": "rises", "why": "so"}
            change = study_points.change(found, "any", over)
            # 10, 11 and 12: a standard deviation of 1 over three.
            self.assertEqual((11.0, 2), (change.size, change.freedom))
            self.assertAlmostEqual(math.sqrt(1.0 / 3.0), change.error)
            # Two levels of rolling friction tell no scatter of the changes over friction: a change, and no error of it.
            change = study_points.change(found, "any", {**over, "input": "mu"})
            self.assertEqual((201.0, None), (change.size, change.error))
            sheet = page.Page("any")
            study_points.add_sign(sheet, found, "any", {**over, "input": "mu"})
            self.assertIn("| f rises with mu | 201 | rises: so | none: no error of the change is known | - |",
                          sheet.text("Any", found, "how"))


class Cases(unittest.TestCase):
    def test_runs_have_one_meaning_each_and_their_scenario_is_there(self):
        plans = cases.all_plans()
        self.assertGreater(len(plans), 200)
        self.assertEqual([p.scenario for p in plans.values() if not p.file().exists()], [])

    def test_watched_bits_are_recorded(self):
        recorded = json.loads((runs.ROOT / runs.BITS).read_text())
        for name in cases.names():
            case = cases.load(name)
            self.assertLessEqual(set(case.BITS), set(recorded), name)
            self.assertTrue(hasattr(case, "write") or hasattr(case, "fill"), name)

    def test_pages_are_written_without_any_run(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in cases.names():
                case = cases.load(name)
                if hasattr(case, "fill"):
                    sheet = page.Page(name)
                    case.fill(sheet, runs.Runs(case.plans(), folder, None))
                    self.assertIn("not run", sheet.text(case.TITLE, runs.Runs([], folder, None), "how").replace("**", ""))


    def test_pages_and_charts_are_written_from_finished_runs(self):
        drawn = []
        with unittest.mock.patch("chart.draw", lambda file, title, across, up, curves: drawn.append((file.name, curves))):
            for name in cases.names():
                case = cases.load(name)
                # A run that is none has no frames.
                if hasattr(case, "fill") and not getattr(case, "READS_FRAMES", False):
                    sheet = page.Page(name)
                    everything = AllRuns(case)
                    case.fill(sheet, everything)
                    text = sheet.text(case.TITLE, everything, "how")
                    self.assertNotIn("| open |", text, name)
                    self.assertNotIn("not run |", text, name)
        self.assertGreater(len(drawn), 10)
        for name, curves in drawn:
            for curve in curves:
                self.assertEqual(len(curve.x), len(curve.y), f"{name}: {curve.name}")


class Figures(unittest.TestCase):
    def test_the_power_of_a_rate_is_found(self):
        points = [(h, 0.58 * 1500 * 9.81 ** 0.5 * (h - 1.4e-3) ** 2.5) for h in (6e-3, 8e-3, 10e-3)]
        exponent, k = beverloo.fit_power(points)
        self.assertAlmostEqual(exponent, 2.5, 6)
        self.assertAlmostEqual(k, 1.4, 6)

    def test_the_lag_of_a_shifted_curve_is_its_shift(self):
        theirs = {0.1 * n: 1000.0 * (n % 9) for n in range(50)}
        ours = {round(0.01 * n, 2): 1000.0 * (((n - 5) // 10) % 9) for n in range(-40, 600)}
        self.assertAlmostEqual(dosta_drum.lag(ours, theirs), 0.05, delta=0.051)

    def test_ergun_is_that_of_the_thesis(self):
        """Mono 0.6 mm at 0.435, 30 l/min: 5.637 mbar over 102.1 mm."""
        speed = 30 / bed.LITRES_PER_MINUTE / bed.VESSEL_SECTION
        self.assertAlmostEqual(bed.ergun(((0.6e-3, 1.0),), 0.565, speed) * 0.1021 / 100, 5.637, delta=0.02)


if __name__ == "__main__":
    unittest.main()

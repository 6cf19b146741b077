#!/usr/bin/env python3
"""dust_results_test.py ENGINE SOURCE VERSION: the Python package against what the engine writes."""

import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ENGINE, SOURCE, VERSION = sys.argv[1:4]
sys.path[:0] = [SOURCE + "/tests/support", SOURCE + "/tools/python"]
import needs_h5py  # noqa: E402, F401
import numpy as np  # noqa: E402

import dust_results  # noqa: E402
from dust_results import Field, ResultsError, Run, Study, Table, Walls  # noqa: E402

FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dust-python-"))


def engine(*arguments):
    subprocess.run([ENGINE, *map(str, arguments), "--quiet"], check=True, capture_output=True)


def setUpModule():
    sys.dont_write_bytecode = True
    engine("run", SOURCE + "/tests/scenario/small_transfer.yaml", "-o", FOLDER / "run", "--threads", "1",
           "--set", "time.end=8 ms", "--set", "time.output_every=4 ms")
    engine("study", SOURCE + "/tests/study/drop_study.yaml", "-o", FOLDER / "study", "--jobs", "1")


def tearDownModule():
    shutil.rmtree(FOLDER, ignore_errors=True)


class ARun(unittest.TestCase):
    def setUp(self):
        self.run_ = Run(FOLDER / "run")

    def test_grains_are_those_the_summary_counts(self):
        grains, summary = self.run_.grains(), self.run_.summary
        self.assertEqual(len(grains), summary["particles"]["in_domain"])
        mass = np.sum(grains["mass"].astype(float) * grains["weight"])
        self.assertAlmostEqual(mass / summary["mass_kg"]["in_domain"], 1, 5)
        self.assertEqual(set(grains["material"]), {"sand"})
        self.assertEqual(grains["position"].shape, (len(grains), 3))
        self.assertEqual(grains.unit("angular_velocity"), "rad/s")

    def test_frames_are_found_by_number_and_by_time(self):
        np.testing.assert_allclose(self.run_.times, [0, 0.004, 0.008])
        self.assertEqual(self.run_.frame_at(0.0045), 1)
        self.assertLess(len(self.run_.grains(0)), len(self.run_.grains(1)))
        with self.assertRaisesRegex(ResultsError, "holds 3 frames, numbered from 0"):
            self.run_.grains(3)

    def test_the_series_ends_where_the_summary_does(self):
        series, summary = self.run_.series, self.run_.summary
        self.assertEqual(len(series), 9)
        self.assertEqual(series["mass_emitted"][-1], summary["mass_kg"]["emitted"])
        self.assertEqual(series.unit("mass_emitted"), "kg")

    def test_a_row_cut_short_is_left_out(self):
        copy = FOLDER / "going_on"
        copy.mkdir()
        text = (FOLDER / "run/series.csv").read_text()
        (copy / "series.csv").write_text(text[:-10])
        run = Run(copy)
        self.assertEqual(len(run.series), 8)
        self.assertEqual(len(run.times), 0)
        with self.assertRaisesRegex(ResultsError, "no summary.json yet"):
            run.summary

    def test_figures_are_found_by_the_names_of_studies(self):
        figures = self.run_.figures
        mass = figures[(figures["sensor"] == "lip") & (figures["figure"] == "forward/mass")]
        self.assertEqual(mass["unit"], ["kg"])
        self.assertEqual(self.run_.value("sensors.lip.forward.mass"), mass["value"][0])
        self.assertEqual(self.run_.value("particles.emitted"),
                         self.run_.summary["particles"]["emitted"])
        with self.assertRaisesRegex(ResultsError, "no figure 'net/mass_rat'.*'net/mass_rate'"):
            self.run_.value("sensors.lip.net.mass_rat")
        for name in ("sensors.lip", "sensors.", "particles.emitted.x", "size_classes.0.diameter_m"):
            with self.assertRaises(ResultsError, msg=name):
                self.run_.value(name)

    def test_figures_with_paths_are_found_by_the_names_of_studies(self):
        folder = FOLDER / "named"
        folder.mkdir()
        rate = {"value": 2.5, "unit": "kg/h", "uncertainty": None}
        summary = {"dust_rates": {"left/right/rate": rate}, "particles": {"emitted": 7}}
        (folder / "summary.json").write_text(json.dumps(summary))
        (folder / "results.h5").write_bytes((FOLDER / "run" / "results.h5").read_bytes())
        run = Run(folder)
        self.assertEqual(run.value("dust_rates.left.right.rate"), 2.5)
        self.assertEqual(run.value("particles.emitted"), 7)
        with self.assertRaisesRegex(ResultsError, "no figure"):
            run.value("dust_rates.left.rigt.rate")

    def test_sizes_and_times_are_tables(self):
        sizes = self.run_.size_classes
        np.testing.assert_allclose(sizes["diameter"], [10e-6, 300e-6, 420e-6, 500e-6, 600e-6])
        self.assertEqual(sizes.unit("mass.emitted"), "kg")
        self.assertAlmostEqual(sizes["mass.emitted"].sum(), self.run_.value("mass_kg.emitted"), 12)
        times = self.run_.timers["time"]
        self.assertTrue(np.all(np.diff(times) <= 0))

    def test_the_air_stands_where_the_scenario_puts_it(self):
        air = self.run_.air()
        self.assertEqual(air["velocity"].values.shape, (70, 4, 66, 3))
        np.testing.assert_allclose(air["pressure"].centres("x")[[0, -1]], [0.0025, 0.3275])
        # Inside the head pulley there is no air, above the belt there is.
        is_open = air["open_fraction"].plane("y") > 0.5
        self.assertFalse(is_open[int(0.158 / 0.005), int(0.080 / 0.005)])
        self.assertTrue(is_open[int(0.252 / 0.005), int(0.080 / 0.005)])
        with self.assertRaisesRegex(ResultsError, "no field 'presure'; there are 'pressure'"):
            air["presure"]

    def test_the_belt_is_cut_where_it_is(self):
        walls = self.run_.walls()
        self.assertEqual(set(walls.body), {"belt"})
        ends = walls.section("y", 0.0055).reshape(-1, 3)
        on_pulley = ends[ends[:, 0] > 0.0801]
        self.assertGreater(len(on_pulley), 10)
        distance = np.hypot(on_pulley[:, 0] - 0.080, on_pulley[:, 2] - 0.158)
        np.testing.assert_allclose(distance, 0.042, rtol=2e-3)

    def test_a_picture_shows_every_grain_at_its_size(self):
        grains = self.run_.grains()
        figure = dust_results.draw_grains(self.run_, colour="diameter")
        circles = figure.axes[0].collections[0]
        self.assertEqual(len(circles.get_offsets()), len(grains))
        np.testing.assert_allclose(circles.get_offsets()[:, 1], 1e3 * grains["position"][:, 2], rtol=1e-6)
        widths = getattr(circles, "get_widths", lambda: 2 * circles._widths)()
        self.assertGreater(widths.min(), 0.2)  # 10 um would not be seen on 200 mm
        figure.savefig(FOLDER / "grains.png")
        self.assertEqual((FOLDER / "grains.png").read_bytes()[:4], b"\x89PNG")

    def test_air_and_series_are_drawn(self):
        velocity = self.run_.air()["velocity"].magnitude().plane("y")
        shown = dust_results.draw_air(self.run_).axes[0].collections[0].get_array()
        self.assertEqual(shown.size, velocity.size)
        self.assertLess(shown.count(), velocity.size)  # what is inside the belt is left out
        figure = dust_results.draw_series(self.run_, "mass_emitted")
        self.assertEqual(figure.axes[0].get_ylabel(), "mass_emitted [kg]")


class AStudy(unittest.TestCase):
    def setUp(self):
        self.study = Study(FOLDER / "study")

    def test_the_table_is_that_of_study_csv(self):
        with open(FOLDER / "study/study.csv", newline="") as stream:
            head, *rows = csv.reader(stream)
        table = self.study.table
        self.assertEqual([dust_results.table.with_unit(name, table.unit(name)) for name in table],
                         [h.replace(" [1]", "") for h in head])
        for name, column in zip(table, zip(*rows)):
            for ours, theirs in zip(table[name], column):
                if table[name].dtype.kind in "fi":
                    self.assertEqual(str(float(ours)), str(float(theirs or "nan")), name)
                else:
                    self.assertEqual(ours, theirs)
        self.assertEqual(self.study.inputs, ["emitters.feed.velocity", "emitters.feed.mass_flow"])
        self.assertEqual(self.study.outputs, ["passed", "rate", "emitted"])
        self.assertEqual(len(self.study.finished), 8)

    def test_a_point_is_a_run(self):
        run = self.study.run(3)
        self.assertEqual(run.value("particles.emitted"), self.study.table["emitted"][2])
        with self.assertRaisesRegex(ResultsError, "without air"):
            run.air()
        with self.assertRaisesRegex(ResultsError, "points 1 to 8, not 9"):
            self.study.run(9)

    def test_outputs_are_drawn_against_inputs(self):
        figure = dust_results.draw_study(self.study, "rate")
        self.assertEqual(figure.axes[0].get_xlabel(), "emitters.feed.mass_flow [g/s]")
        self.assertEqual(figure.axes[0].get_ylabel(), "rate [g/s]")

    def test_the_wrong_folder_is_told(self):
        with self.assertRaisesRegex(ResultsError, "use dust_results.Study"):
            Run(FOLDER / "study")
        with self.assertRaisesRegex(ResultsError, "use dust_results.Run"):
            Study(FOLDER / "run")
        with self.assertRaisesRegex(ResultsError, "not the folder of a run"):
            Run(FOLDER / "nowhere")


class Parts(unittest.TestCase):
    def test_a_table_is_cut_by_mask_row_and_names(self):
        table = Table({"a": [1, 2, 3], "v": np.arange(9.0).reshape(3, 3)}, {"a": "kg", "v": "m/s"})
        self.assertEqual(list(table[table["a"] > 1]["a"]), [2, 3])
        self.assertEqual(list(table[-1]["a"]), [3])
        self.assertEqual(table[["v"]].names, ["v"])
        self.assertEqual(table.scalars().names, ["a", "v_x", "v_y", "v_z"])
        table.write_csv(FOLDER / "t.csv")
        self.assertEqual((FOLDER / "t.csv").read_text().splitlines()[:2],
                         ["a [kg],v_x [m/s],v_y [m/s],v_z [m/s]", "1,0.0,1.0,2.0"])
        with self.assertRaisesRegex(ResultsError, "no column 'b'"):
            table["b"]

    def test_a_field_is_cut_at_a_coordinate(self):
        k, j, i = np.meshgrid(range(4), range(3), range(2), indexing="ij")
        field = Field("f", 100 * k + 10 * j + i, "1", [-1, 0, 0], [0.5, 1, 2], 0)
        np.testing.assert_array_equal(field.plane("y", 2.5), 100 * k[:, 2] + 20 + i[:, 2])
        np.testing.assert_array_equal(field.plane("x", -0.9), 100 * k[:, :, 0] + 10 * j[:, :, 0])
        np.testing.assert_allclose(field.centres("z"), [1, 3, 5, 7])

    def test_a_tetrahedron_is_cut_in_a_triangle(self):
        points = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]])
        triangles = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        ends = Walls(points, triangles, np.array(["t"] * 4)).section("z", 1.0)
        self.assertEqual(len(ends), 3)
        corners = sorted({tuple(p) for p in np.round(ends.reshape(-1, 3), 9)})
        self.assertEqual(corners, [(0, 0, 1), (0, 1, 1), (1, 0, 1)])

    def test_the_version_is_that_of_the_engine(self):
        self.assertEqual(dust_results.__version__, VERSION)


try:
    import matplotlib  # noqa: F401
except ImportError:
    print("pictures are not tested: Matplotlib (package python3-matplotlib) is needed")
    for case, names in ((ARun, ("test_a_picture_shows_every_grain_at_its_size", "test_air_and_series_are_drawn")),
                        (AStudy, ("test_outputs_are_drawn_against_inputs",))):
        for name in names:
            delattr(case, name)

unittest.main(argv=sys.argv[:1])

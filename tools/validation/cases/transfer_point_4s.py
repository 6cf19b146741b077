"""The transfer point over the 4 s that the thesis simulates."""

import every_figure
from chart import Curve
from runs import Plan

TITLE = "The transfer point over 4 s"
BITS = ("transfer_point", "rare_sizes", "mixer")
NAME = "transfer_point_4s"
OPENINGS = ("dust_out_below_belt", "dust_out_above_belt", "dust_out_right")


def plans():
    # The first of the study dust_4s, whose seed is the default: one run serves both.
    return [Plan(NAME, "thesis/transfer_point_4s.yaml", {"seed": "1"})]


def fill(page, runs):
    run = runs[NAME]
    median = run.figure("stream", "drop_140_mm/median")
    page.add("median 140 mm below the belt [mm]", median and (1e3 * median[0], 1e3 * (median[1] or 0.0)),
             "128.1 (one grain of 600 um in still air), 135.2 (in vacuum)", 120, 135)
    for sensor in OPENINGS:
        page.add(f"{sensor} [g/t]", run.figure(sensor, "forward/grams_per_tonne"), "-", why="the thesis shows where dust goes, not how much")
    curves = []
    for sensor in ("loose_dust", "dust_above_feed"):
        column = next((c for c in (run.series() or [{}])[0] if c.startswith(f"{sensor}/mass")), None)
        if column:
            times, values = run.curve(column)
            curves.append(Curve(f"{sensor}: {column.split('/', 1)[1]}", times, values))
    page.chart("Loose dust", "time [s]", "as named", curves, "In the eddy under the belt and above the feed.")
    page.body(every_figure.lines([("4 s", run)]))

"""The same dust as grains and as a field, set free at one place of the thesis's transfer point."""

import math
import sys

from chart import Curve
from runs import ROOT, Plan

TITLE = "The same dust twice: free grains of 10 um and a field of 10 um"
BITS = ("transfer_point", "rare_sizes", "dust_field")
READS_FRAMES = True
TIMES = (0.5, 0.6, 0.7)  # s
FREED = 27.75e-9         # kg/s of each, as the scenario says
BEGIN, END = 0.35, 0.7   # s
RUNS = {"same_dust": ("cells of 2.5 mm", {}), "same_dust_fine": ("cells of 1.25 mm", {"fluid.cells": "[264, 9, 280]"})}
JUDGED = "same_dust_fine"
NOTE = """10 um of sand are set free from 0.35 to 0.7 s in a box 2.5 mm high, 1 mm below the return run of the belt: 20,000 grains a second, each tracked,
and as much as a concentration. The standard error is that of so many independent grains. Both are carried by the same air. The grains come from
five planes over the height of the source, for the air's speed falls over it. It is set free where no sand falls: in the stream grains are hit by
sand and taken down with it, a field is not (`scavenging: true` is there for that).

At 0.5 s the first of it gets to the outlet: the front of the field, smeared over some cells, is there a little before the first grains, by 1.6 % of what has
been set free. What has left by 0.6 and 0.7 s agrees within the error of the grains in cells of 1.25 mm; in cells of 2.5 mm, which do not resolve the layer of
air below the belt, it is off by up to 2.8 % at 0.6 s."""


def plans():
    return [Plan(name, "dust/same_dust_twice.yaml", settings) for name, (_, settings) in RUNS.items()]


def left_over(run):
    """(times [s], share of what was set free until then that is still inside: grains, field, number of grains freed)."""
    sys.path.append(str(ROOT / "tools/python"))
    import dust_results  # wants numpy and h5py, which nobody needs to list cases

    results = dust_results.Run(run.folder)
    mass = {round(row["time [s]"], 6): row for row in run.series()}
    rows = []
    for n, time in enumerate(results.times):
        freed = FREED * (min(time, END) - BEGIN)
        row = mass.get(round(time, 6))
        if time < BEGIN + 0.04 or row is None:
            continue
        diameters = results.grains(n)["diameter"]
        small = diameters < 50e-6
        number = freed / (2650 * math.pi / 6 * 1e-15)
        rows.append((time, small.sum() / number, row["dust_field/10_um/airborne [kg]"] / freed, number))
    return rows


def fill(page, runs):
    curves = []
    for name, (text, _) in RUNS.items():
        rows = left_over(runs[name]) if runs[name].is_finished() else []
        add_times(page, text, rows, None if name == JUDGED else "an experiment: what coarser cells do")
        times = [row[0] for row in rows]
        curves += [Curve(f"grains, {text}", times, [r[1] for r in rows]), Curve(f"field, {text}", times, [r[2] for r in rows])]
    page.chart("Dust still inside", "time [s]", "share of what was set free [-]", curves,
               "Set free below the return run from 0.35 to 0.7 s; the belt carries it out at the left.")
    page.note(NOTE)


def add_times(page, text, rows, why):
    """The rows of a run; judged where there is no reason `why` not to."""
    band = () if why else (-3, 3)
    for time in TIMES:
        what = f"share still inside at {time} s, {text}"
        row = next((r for r in rows if abs(r[0] - time) < 1e-6), None)
        grains = difference = None
        theirs = "-"
        if row:
            _, share, field, number = row
            error = math.sqrt(max(share * (1 - share), 1 / number) / number)
            grains, theirs, difference = (share, error), f"{field:.4f} as a field", (field - share) / error
        page.add(f"{what}: grains", grains, theirs, why="the next row judges it")
        page.add(f"{what}: field less grains, in standard errors of the grains", difference, "0", *band, why=why)

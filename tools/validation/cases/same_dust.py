"""The same dust as grains and as a field, set free at one place of the thesis's transfer point."""

import math
import sys

from chart import Curve
from runs import ROOT, Plan

TITLE = "The same dust twice: free grains of 10 um and a field of 10 um"
BITS = ("transfer_point", "rare_sizes")
READS_FRAMES = True
TIMES = (0.5, 0.6, 0.7)  # s
FREED = 27.75e-9         # kg/s of each, as the scenario says
BEGIN, END = 0.35, 0.7   # s


def plans():
    return [Plan("same_dust", "dust/same_dust_twice.yaml")]


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
    run = runs["same_dust"]
    rows = left_over(run) if run.is_finished() else []
    for time in TIMES:
        what = f"share still inside at {time} s"
        row = next((r for r in rows if abs(r[0] - time) < 1e-6), None)
        if row is None:
            page.add(f"{what}, grains", None, "-", why="the field's is judged by it")
            page.add(f"{what}, field less grains, in standard errors of the grains", None, "0", -3, 3)
            continue
        _, grains, field, number = row
        error = math.sqrt(max(grains * (1 - grains), 1 / number) / number)
        page.add(f"{what}, grains", (grains, error), f"{field:.4f} as a field", why="the next row judges it")
        page.add(f"{what}, field less grains, in standard errors of the grains", (field - grains) / error, "0", -3, 3)
    if rows:
        page.chart("Dust still inside", "time [s]", "share of what was set free [-]",
                   [Curve("grains", [r[0] for r in rows], [r[1] for r in rows]), Curve("field", [r[0] for r in rows], [r[2] for r in rows])],
                   "Set free below the return run from 0.35 to 0.7 s; the belt carries it out at the left.")
    page.note("10 um of sand are set free from 0.35 to 0.7 s in a box 2.5 mm high, 1 mm below the return run of the belt: 20,000 grains a second, each tracked, "
              "and as much as a concentration. The standard error is that of so many independent grains. Both are carried by the same air; the field has no "
              "inertia, does not bounce off the belt, and is smeared over its cells of 2.5 mm, of which the belt's layer has one or two: a few hundredths of the dust "
              "leave later or earlier for that, more than 7,000 grains scatter. The grains come from five planes over the height of the source, for the "
              "air's speed falls over it.")
    page.note("It is set free where no sand falls: in the stream grains are hit by sand and taken down with it, a field is not (`scavenging: true` "
              "is there for that).")

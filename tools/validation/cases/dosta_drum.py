"""A rotating drum after Dosta et al. (2024): grains in a quarter over time."""

import bisect

from chart import Curve, published
from runs import Plan, read_table

TITLE = "A rotating drum after Dosta et al. (2024)"
BITS = ("dosta_drum",)
SOFT = {"materials.m1.young_modulus": "10 MPa", "materials.m2.young_modulus": "5 MPa"}
# The first two extrema of the published curve: a maximum and the minimum after it.
EXTREMA = ((max, 0.3, 1.2), (min, 1.0, 2.2))
START = 0.5  # [s], when the drum begins to turn


def plans():
    return [Plan("dosta_drum", "thesis/dosta_drum.yaml", SOFT)]


def fill(page, runs):
    theirs = {float(r["time_s"]): float(r["musen_z2_m1"]) for r in read_table("dosta_drum_zones.csv") if r["musen_z2_m1"]}
    run = runs["dosta_drum"]
    ours = {round(r["time [s]"] - START, 4): r["m1_below/number [1]"] for r in run.series()}
    at = lambda t: ours[min(ours, key=lambda s: abs(s - t))] if ours else None
    for half in range(10):
        page.add(f"M1 in the quarter x < 0, z < 0 after {0.5 * half:g} s", at(0.5 * half), f"{theirs[0.5 * half]:.0f} (MUSEN)",
                 why="a point on a steep curve; its extrema and its lag are judged")
    most, least = (extremum(theirs, *EXTREMA[n]) for n in (0, 1))
    ours_most, ours_least = (extremum(ours, *EXTREMA[n]) if ours else None for n in (0, 1))
    page.add("first extremum of it, the maximum", ours_most, f"{most:.0f} (MUSEN)", 0.85 * most, 1.15 * most, band="within 15 %")
    add_minimum(page, ours_least, least, most - least)
    page.add("lag behind the paper [s]", lag(ours, theirs) if ours else None, "0", -0.15, 0.15)
    page.chart("Small grains in the quarter x < 0, z < 0", "time since the drum turns [s]", "grains",
               [Curve("ours", list(ours), list(ours.values())),
                published("MUSEN", theirs, theirs.values(), is_points=False)], "Ours beside the published counts.")
    page.note("Own packing: grains rained, the drum began to turn at 0.5 s. The lag is the shift in time that brings both "
              "curves nearest to each other, in the mean of squares.")
    codes = read_table("dosta_drum_zones.csv")
    both = [(r["musen_z2_m1"], r["liggghts_z2_m1"]) for r in codes if float(r["time_s"]) == 1.6][0]
    page.note(f"At the minimum hardly a grain is left in the quarter: the paper's two codes, from one packing, have {both[0]} "
              f"(MUSEN) and {both[1]} (LIGGGHTS) of 30,000 at 1.6 s, so a band of 15 % of {both[0]} grains judges chance. It "
              "stands with its verdict all the same; beside it the minimum by the swing from the maximum down to it.")


def extremum(curve, best, first, last):
    return best(number for t, number in curve.items() if first <= t <= last)


def add_minimum(page, ours, theirs, swing):
    page.add("second extremum of it, the minimum", ours, f"{theirs:.0f} (MUSEN)", 0.85 * theirs, 1.15 * theirs,
             band="within 15 %")
    page.add("the same by the swing from the maximum", ours / swing if ours is not None else None, f"{theirs / swing:.4f} (MUSEN)",
             0.0, 0.15, band="within 15 % of the swing")


def lag(ours, published):
    """Shift [s] of our curve by which it fits the published one best."""
    times = sorted(ours)

    def misfit(shift):
        total = 0.0
        for t, number in published.items():
            if not 0.3 <= t <= 4.6:
                continue
            here = bisect.bisect_left(times, t + shift)
            total += (ours[times[min(here, len(times) - 1)]] - number) ** 2
        return total

    return min((0.01 * n for n in range(-30, 31)), key=misfit)

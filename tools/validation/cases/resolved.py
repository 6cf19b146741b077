"""Resolved spheres: cases B1 to B4 of chapter 3 (ten Cate et al. 2002), and two that sink one behind the other."""

import dataclasses
import math
import statistics
import sys

from cases.settling_b import TEN_CATE
from chart import Curve, published
from runs import ROOT, Plan, read_table

TITLE = "Resolved spheres: cases B1 to B4, a sphere of 15 mm in silicone oil; two spheres that draft, kiss and tumble"
BITS = ("resolved_sphere",)
READS_FRAMES = True
DIAMETER, FALL = 0.015, 0.12  # [m]
LARGEST = 0.03  # of the fall
PAIR, PAIR_DIAMETER = "draft_kiss_tumble", 1.6667e-3  # [m]
TOUCH = 0.02  # of a diameter between two surfaces


def plans():
    return [Plan(f"resolved_b{number}", f"thesis/settling_b{number}_resolved.yaml") for number in TEN_CATE] + [
        Plan(PAIR, "verification/draft_kiss_tumble.yaml")]


def fill(page, runs):
    for number, (infinite, share) in TEN_CATE.items():
        run = runs[f"resolved_b{number}"]
        largest = share * infinite
        page.add(f"B{number}: largest velocity [m/s]", run.figure("fall", "largest/velocity"), f"{largest:.4f} (measured)",
                 low=0.95 * largest, high=1.05 * largest, band="within 5 % of the measured one")
        page.add(f"B{number}: velocity 60 mm over the floor [m/s]", run.figure("fall", "level_60_mm/velocity"), f"{largest:.4f} (largest measured)",
                 why="the measured velocity there is not tabulated here")
        page.add(f"B{number}: gap of 15 mm passed after [s]", run.figure("fall", "level_15_mm/time"), "-", why="no table of it here")
    run = runs["resolved_b1"]
    page.add("B1: mean distance from the measured way, over the fall of 120 mm", distance(run, "mean", statistics.mean), "0 (measured)", high=LARGEST)
    page.add("B1: largest distance from it", distance(run, "largest", max), "0 (measured)", high=LARGEST)
    page.add("B1: largest distance from it, counted from where 7.5 diameters are left", distance(run, "largest since", max, 7.5 * DIAMETER),
             "0 (measured)", high=LARGEST)
    draw(page, runs)
    times, gaps = measured_gaps()
    page.chart("Gap between sphere and floor, B1", "time [s]", "gap [mm]",
               [Curve("B1", *gap_curve(run, 1e3)), published("B1, measured", times, [1e3 * gap for gap in gaps])],
               "Measured: ten Cate et al. 2002, figure 5a, as others have read it off (docs/validation/data/tencate_2002_gap_b1.csv). Its first point "
               f"still stands at {gaps[0] / DIAMETER:.2f} diameters after {times[0]:.2f} s, and from 0.5 to 2.5 s it falls by "
               f"{1e3 * (between(times, gaps, 0.5) - between(times, gaps, 2.5)) / 2:.0f} mm/s, where the largest measured velocity is "
               f"{1e3 * math.prod(TEN_CATE[1]):.0f}: the figure's "
               "zero and its scale are no better known than that. Of B2 to B4 no table is at hand: their times stand above beside nothing.")
    fill_pair(page, runs[PAIR])
    page.note("The sphere is 12 cells across; neither a drag law nor a rule of the void fraction is asked "
              "([theory](../theory/resolved.md)). The same cases with an unresolved sphere: [settling_b.md](settling_b.md).")
    page.note("Cubic arrays of spheres in Stokes flow (Zick and Homsy 1982), one sphere in a stream at Re 20, 50 and 100, and films beside a wall and between "
              "two spheres are tests, V-ARRAY, V-STREAM and V-FILM in tests/verification/resolved; their figures stand in the theory.")


def fill_pair(page, run):
    ways = pair_ways(run) if run.is_finished() else []
    touch = run.read_off("results", "time of touch", lambda: first(ways, lambda w: w.gap < TOUCH))
    turned = run.read_off("results", "time of tumbling", lambda: first(ways, lambda w: w.angle > 45 and w.over_floor > 1))
    faster = run.read_off("results", "speeds before touch", lambda: (max(w.speeds for w in ways if w.time < touch[0]), None) if touch else None)
    page.add("two spheres, draft: speed of the one behind over that of the one before it, the most before they touch", faster, "above 1", low=1.05)
    page.add("two spheres, kiss: they touch after [s]", touch, "-", why="the time hangs on small errors in a fall of two that are alike; the order is what is held")
    page.add("two spheres, tumble: their line turned by 45 deg, more than a diameter over the floor, after [s]", turned, "after the kiss", low=touch[0] if touch else 0.0, band="later than the kiss")
    page.chart("Two spheres that draft, kiss and tumble", "time [s]", "gap [diameters]; angle [90 deg]",
               [Curve("gap between the surfaces", [w.time for w in ways], [w.gap for w in ways]),
                Curve("angle of their centres from the vertical, in quarters of a turn", [w.time for w in ways], [w.angle / 90 for w in ways])],
               "Above one quarter the sphere that was behind is the lower one. Order: Glowinski et al. (J. Comput. Phys. 169 (2001) 363).")


@dataclasses.dataclass(frozen=True)
class Way:
    """Two spheres at an instant."""
    time: float    # [s]
    gap: float     # between their surfaces, in diameters
    angle: float   # [deg] of the line from the one before to the one behind, from the vertical
    speeds: float  # of the one behind over that of the one before
    over_floor: float  # gap between the lower one and the floor, in diameters


def pair_ways(run):
    sys.path.append(str(ROOT / "tools/python"))
    import dust_results  # wants numpy and h5py, which nobody needs to list cases

    results = dust_results.Run(run.folder)
    ways = []
    for n, time in enumerate(results.times):
        grains = results.grains(n)
        if len(grains["id"]) < 2:
            continue
        before, behind = (list(grains["id"]).index(number) for number in sorted(grains["id"]))
        apart = grains["position"][behind] - grains["position"][before]
        distance = math.dist(grains["position"][behind], grains["position"][before])
        speeds = grains["velocity"][behind][2] / grains["velocity"][before][2] if grains["velocity"][before][2] < 0 else 1.0
        ways.append(Way(float(time), distance / PAIR_DIAMETER - 1, math.degrees(math.acos(apart[2] / distance)), speeds,
                        min(grains["position"][:, 2]) / PAIR_DIAMETER - 0.5))
    return ways


def first(ways, is_there):
    at = next((w.time for w in ways if is_there(w)), None)
    return (at, None) if at is not None else None


def measured_gaps():
    """(times [s], gaps between sphere and floor [m]) of B1."""
    rows = read_table("tencate_2002_gap_b1.csv")
    return [float(r["time_s"]) for r in rows], [DIAMETER * float(r["gap_over_diameter"]) for r in rows]


def gap_curve(run, scale=1.0):
    # In the row of the beginning there is no sphere yet.
    return run.curve("fall/height [m]", scale, since=1e-6)


def distance(run, name, of, since=None):
    """Mean or largest distance between a run's gap and the measured ones at their times, over the height of the fall; with the time that
    both pass a gap of `since` [m] for its beginning, if that is given."""
    def find():
        at, ours = gap_curve(run)
        times, gaps = measured_gaps()
        if not at:
            return None
        lead = passing(times, gaps, since) - passing(at, ours, since) if since else 0.0
        return (of([abs(between(at, ours, time - lead) - gap) for time, gap in zip(times, gaps) if time > lead]) / FALL, None)
    return run.read_off("series", f"{name} distance from the measured gap", find)


def between(times, values, time):
    """Linearly between two instants of a series, whose ends stand for what lies beyond."""
    last = next((n for n, t in enumerate(times) if t >= time), 0)
    if last == 0:
        return values[0] if time <= times[0] else values[-1]
    share = (times[last] - time) / (times[last] - times[last - 1])
    return values[last] - share * (values[last] - values[last - 1])


def passing(times, gaps, gap):
    """When a gap that closes passes a value."""
    return between([-g for g in gaps], times, -gap)


def draw(page, runs):
    curves = []
    for number, (infinite, share) in TEN_CATE.items():
        run = runs[f"resolved_b{number}"]
        column = next((c for c in (run.series() or [{}])[0] if "velocity" in c and c.startswith("fall/")), None)
        if column:
            curves.append(Curve(f"B{number}", *run.curve(column)))
        curves.append(published(f"B{number}, largest measured", [0, 4], [share * infinite] * 2, is_points=False))
    page.chart("Speed of the sphere", "time [s]", "speed [m/s]", curves, "Lines: largest measured velocities (ten Cate et al. 2002).")

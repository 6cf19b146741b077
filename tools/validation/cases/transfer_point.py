"""The transfer point of chapter 6 as shipped, with and without air, beside the flight of one grain."""

import every_figure
from chart import Curve, published
from runs import Plan

TITLE = "The transfer point at 0.8 m/s, 6 g/s"
BITS = ("transfer_point", "rare_sizes", "mixer")
RUNS = {"with air": Plan("transfer_point", "transfer_point.yaml"),
        "without air": Plan("transfer_point_without_air", "transfer_point.yaml", {"fluid": "none"})}
DROPS = (20, 50, 100, 140)


def plans():
    return list(RUNS.values())


def fill(page, runs):
    for label, plan in RUNS.items():
        run = runs[plan.name]
        median = run.figure("stream", "drop_140_mm/median")
        page.add(f"{label}: median 140 mm below the belt [mm]", median and (1e3 * median[0], 1e3 * (median[1] or 0.0)),
                 "128.1 (one grain of 600 um in still air), 135.2 (in vacuum)", 120, 135.2 if label == "with air" else 137)
        page.add(f"{label}: vertical speed at A [m/s]", run.figure("stream", "at_a/median_vertical_speed"), "0 (tangent release)",
                 high=0.05)
    air, vacuum = (runs[plan.name].figure("stream", "drop_140_mm/median") for plan in RUNS.values())
    page.add("without air less with air [mm]", 1e3 * (vacuum[0] - air[0]) if air and vacuum else None,
             "without air the stream lies to the right", low=0.0)
    draw(page, runs)
    page.body(every_figure.lines([(label, runs[plan.name]) for label, plan in RUNS.items()]))


def draw(page, runs):
    curves = []
    for label, plan in RUNS.items():
        found = [(drop, runs[plan.name].figure("stream", f"drop_{drop}_mm/median")) for drop in DROPS]
        curves.append(Curve(label, [1e3 * f[0] for _, f in found if f], [-d for d, f in found if f], is_points=True))
    fall = [2 * n for n in range(71)]
    curves.append(published("throw in vacuum at 0.8 m/s", [800 * (2e-3 * d / 9.81) ** 0.5 for d in fall], [-d for d in fall], is_points=False))
    page.chart("Median of the stream", "x - x_A [mm]", "z - z_A [mm]", curves, "Medians at four heights, beside the throw of one grain.")

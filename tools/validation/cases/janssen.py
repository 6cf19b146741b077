"""A column of grains between rough and smooth walls: what the floor carries."""

import math

from chart import Curve, published
from runs import Plan

TITLE = "A column of grains after Janssen"
BITS = ("container_walls", "dosta_drum")


def plans():
    return [Plan("janssen_rough", "verification/janssen.yaml"),
            Plan("janssen_smooth", "verification/janssen.yaml",
                 {"interactions[1].contact.friction": "0", "bodies.floor.start": "1 s"})]


def floor_share(run):
    """Load of the floor over the weight, over the last 0.14 s: the column swings with a period of
    23 ms between smooth walls, which a smooth window over six periods takes out."""
    load = weights = 0.0
    for row in run.series():
        share = (row["time [s]"] - 0.18) / 0.14
        if 0.0 < share < 1.0:
            weight = math.sin(math.pi * share) ** 2
            load -= weight * row["floor_load/force_z [N]"]
            weights += weight
    return load / weights / (9.81 * run.summary["mass_kg"]["in_domain"])


def fill(page, runs):
    for name, text, low, high in (("janssen_rough", "rough walls", None, 0.6), ("janssen_smooth", "smooth walls", 0.99, 1.01)):
        run = runs[name]
        share = floor_share(run) if run.is_finished() else None
        page.add(f"{text}: load of the floor over weight", share, "-" if high == 0.6 else "1", low, high)
    curves = []
    for run in runs:
        if run.is_finished():
            weight = 9.81 * run.summary["mass_kg"]["in_domain"]
            curves.append(Curve(run.name, *run.curve("floor_load/force_z [N]", -1 / weight)))
    page.chart("Load of the floor", "time [s]", "load / weight", [*curves, published("weight", [0, 0.32], [1, 1], is_points=False)],
               "The floor moves down in the rough run and mobilises the friction of the walls; figures are means over the "
               "last 0.14 s.")

"""Rare grains computed several times over, each with a part of the weight: figures must not depend on how many."""

import every_figure
from runs import Plan

TITLE = "Rare grains: 20, 5 and 80 computed for each real one (cells [132, 5, 140], 0.75 s)"
BITS = ("transfer_point", "rare_sizes", "mixer")
COPIES = (20, 5, 80)
FIGURES = (("lip", "class_10_um/forward/mass_rate", "dust past the lip [kg/s]"),
           ("stream", "drop_140_mm/median", "median 140 mm below the belt [m]"))


def plans():
    return [Plan(f"rare_copies_{n}", "transfer_point.yaml",
                 {"time.end": "0.75 s", "fluid.cells": "[132, 5, 140]", "emitters.feed.copies_of_rare": str(n)}) for n in COPIES]


def fill(page, runs):
    for sensor, figure, text in FIGURES:
        base = runs["rare_copies_20"].figure(sensor, figure)
        for n in COPIES[1:]:
            ours = runs[f"rare_copies_{n}"].figure(sensor, figure)
            error = ((base[1] or 0.0) ** 2 + (ours[1] or 0.0) ** 2) ** 0.5 if base and ours else 0.0
            page.add(f"{text}: {n} copies less 20, in standard errors of the difference", (ours[0] - base[0]) / error if error else None,
                     "0", -3, 3)
    page.body(every_figure.lines([(f"{n} copies", runs[f"rare_copies_{n}"]) for n in COPIES]))

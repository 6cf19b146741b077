"""Cases A2 and A1 of chapter 3: a grain let go in air above water."""

from chart import Curve, published
from runs import Plan

TITLE = "Cases A2 and A1: a grain let go in air above water"
BITS = ("settling_a1",)
SCENARIO = "thesis/settling_air_to_water.yaml"
VARIANTS = (("air_to_water", "", {}),
            ("air_to_water_schiller_naumann", ", Schiller and Naumann", {"drag.model": "schiller_naumann"}),
            ("air_to_water_d_dx_0.25", ", D/dx 0.25", {"fluid.cells": "[5, 5, 15]"}),
            # The thesis (Figure 3.9) compares the three rules; with a sphere spread over its own volume.
            ("air_to_water_centre", ", centre", {"voidage.model": "centre"}),
            ("air_to_water_big_particle", ", big particle", {"voidage.model": "big_particle"}))


def plans():
    return [Plan(name, SCENARIO, settings) for name, _, settings in VARIANTS]


def fill(page, runs):
    for name, text, _ in VARIANTS:
        run = runs[name]
        page.add(f"speed at the surface{text} [m/s]", run.figure("fall", "level_30_mm/velocity"), "0.539 (one sphere)",
                 low=0.528, high=0.550, band="0.528 to 0.55 (2 %)")
        page.add(f"time at the surface{text} [s]", run.figure("fall", "level_30_mm/time"), "0.0555 (one sphere)",
                 low=0.0544, high=0.0566, band="0.0544 to 0.0566 (2 %)")
        page.add(f"sinks at{text} [m/s]", run.figure("fall", "velocity"), "0.158 (one sphere), 0.150-0.160 (thesis)",
                 low=0.150, high=0.165)
        page.add(f"near the floor after{text} [s]", run.figure("fall", "level_1_mm/time"),
                 "0.207 (one sphere), about 0.2 (thesis)", low=0.19, high=0.22)
    draw(page, runs)


def draw(page, runs):
    curves = []
    for name, text, _ in VARIANTS:
        column = next((c for c in (runs[name].series() or [{}])[0] if "velocity" in c and c.startswith("fall/")), None)
        if column:
            curves.append(Curve(text.strip(", ") or "Gidaspow, divided", *runs[name].curve(column)))
    # As in the scenario: one sphere, drag coefficient of Abraham, added mass 0.5.
    times = (0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.0555, 0.06, 0.07, 0.08, 0.09, 0.1, 0.12, 0.14, 0.16, 0.18, 0.2, 0.207)
    speeds = (0, 0.0979, 0.1956, 0.2930, 0.3901, 0.4867, 0.539, 0.4196, 0.2876, 0.2282, 0.1977, 0.1811, 0.1661, 0.1610,
              0.1592, 0.1585, 0.1583, 0.1582)
    page.chart("From air into water", "time [s]", "speed [m/s]",
               [*curves, published("one sphere, Abraham", times, speeds, is_points=False)],
               "The published curve has an added mass of half the fluid's; ours has none.")

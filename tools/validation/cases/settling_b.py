"""Cases B1 to B4 of chapter 3: a sphere of 15 mm in silicone oil (ten Cate et al. 2002)."""

from chart import Curve, published
from runs import Plan

TITLE = "Cases B1 to B4: a sphere of 15 mm in silicone oil"
BITS = ("settling_a1",)
# u_inf [m/s], and the largest measured velocity over it.
TEN_CATE = {1: (0.038, 0.947), 2: (0.060, 0.953), 3: (0.091, 0.959), 4: (0.128, 0.955)}
# Of every case, and of B1 alone as the thesis has it: drag law, D/dx, coupling interval (dem_step 50 us).
KINDS = {"with": {}, "without": {"fluid_forces": "[]"}, "gidaspow": {"drag.model": "gidaspow", "fluid_forces": "[]"}}
B1_ONLY = {"di_felice": {"drag.model": "di_felice", "fluid_forces": "[]"},
           "d_dx_2": {"drag.model": "gidaspow", "fluid_forces": "[]", "fluid.cells": "[13, 13, 21]"},
           "d_dx_6": {"drag.model": "gidaspow", "fluid_forces": "[]", "fluid.cells": "[40, 40, 64]"},
           "interval_10": {"drag.model": "gidaspow", "fluid_forces": "[]", "time.fluid_step": "0.5 ms"}}
SHOWN = {"with": "with lubrication", "without": "without lubrication", "gidaspow": "Gidaspow, without lubrication",
         "di_felice": "Di Felice, without lubrication", "d_dx_2": "Gidaspow, D/dx 2", "d_dx_6": "Gidaspow, D/dx 6",
         "interval_10": "Gidaspow, coupling interval 10"}


def variants():
    return [(number, kind, settings) for number in TEN_CATE
            for kind, settings in (KINDS | (B1_ONLY if number == 1 else {})).items()]


def plans():
    return [Plan(f"settling_b{number}_{kind}", f"thesis/settling_b{number}.yaml", settings)
            for number, kind, settings in variants()]


def fill(page, runs):
    for number, kind, _ in variants():
        add(page, runs[f"settling_b{number}_{kind}"], number, f"B{number} {SHOWN[kind]}", "law" if kind in ("with", "without") else kind)
    draw(page, runs)
    page.note("The published u_inf is that of Abraham's drag coefficient, the law of the runs with and without lubrication; a "
              "law of 6 % higher velocity (Schiller and Naumann's in B2) would be as much higher here. The largest measured "
              "velocity is lower by the walls, of which an unresolved sphere feels a part only.")
    page.note("The velocity is taken where the measured one is steady. The largest one is that of the start: the flow the "
              "sphere takes along is taken off with a build-up in closed form that is slower than the true one at first, and "
              "virtual mass and memory of the liquid are left out.")


def add(page, run, number, label, law):
    infinite, share = TEN_CATE[number]
    text = f"{infinite} (u_inf), {share * infinite:.4f} (largest measured)"
    page.add(f"{label}: velocity 60 mm over the floor [m/s]", run.figure("fall", "level_60_mm/velocity"), text,
             low=0.92 * infinite, high=1.08 * infinite, band="within 8 % of u_inf")
    page.add(f"{label}: largest velocity [m/s]", run.figure("fall", "largest/velocity"), text,
             why="an unresolved sphere is held against u_inf where it is steady")
    if law == "law":
        page.add(f"{label}: gap of 15 mm passed after [s]", run.figure("fall", "level_15_mm/time"), "-", why="no table of it here")
        page.add(f"{label}: velocity 1 mm over the floor [m/s]", run.figure("fall", "level_1_mm/velocity"), "-",
                 why="no table of it here")


def draw(page, runs):
    curves = []
    for number, (infinite, share) in TEN_CATE.items():
        run = runs[f"settling_b{number}_with"]
        column = next((c for c in (run.series() or [{}])[0] if "velocity" in c and c.startswith("fall/")), None)
        if column:
            times, speeds = run.curve(column)
            curves.append(Curve(f"B{number}", times, speeds))
        curves.append(published(f"B{number}, largest measured", [0, 4], [share * infinite] * 2, is_points=False))
    page.chart("Speed of the sphere", "time [s]", "speed [m/s]", curves,
               "Lines: largest measured velocities (ten Cate et al. 2002).")

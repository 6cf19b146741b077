"""The bed of 100 mm of chapter 5, frozen: its pressure drop beside Ergun's law."""

import json

from bed import LITRES_PER_MINUTE, SAND_DENSITY, SIZES, VESSEL_SECTION, ergun
from chart import Curve, published
from runs import Plan

TITLE = "Pressure drop of the fixed bed of 100 mm"
BITS = ("fluidised_bed_column",)
FLOWS = {10: "2.7 (thesis, measured), 2.54 (Ergun)", 20: "5.40 (measured), 5.26 (Ergun)",
         30: "8.20 (measured), 8.16 (Ergun)", 40: "10.93 (measured), 11.24 (Ergun)"}
SLICE, MASS = 3e-3 * 3e-3, 1.377e-3  # [m2], [kg]
CELLS = (75, 50, 25)
LATTICE = "lattice of 0.5044 mm"


def plans():
    return [Plan("fixed_bed_settling", "thesis/fixed_bed_settling.yaml"), *plans_of(LATTICE, {})]


def later(runs):
    """The sand itself, as the first run leaves it; the cells are fitted to it, so that it ends on a border of cells."""
    height = runs["fixed_bed_settling"].figure("height", "twice_centre")
    if not height:
        return []
    file = json.dumps({"model": "file", "material": "sand", "with_velocities": False, "allowed_overlap": 0.2,
                       "file": "$RUNS/fixed_bed_settling/results.h5"})
    return plans_of("sand", {"domain.max": f"[0.003, 0.003, {2.5 * height[0]:.6g}]", "emitters.sand": file})


def name_of(bed, cells, flow):
    return f"fixed_bed_{bed.split()[0]}_{cells}_{flow}"


def speed_of(flow):
    return flow / LITRES_PER_MINUTE / VESSEL_SECTION


def plans_of(bed, settings):
    return [Plan(name_of(bed, cells, flow), "thesis/fixed_bed_100mm.yaml",
                 {**settings, "fluid.cells": f"[1, 1, {cells}]",
                  "domain.boundaries.bottom.air.speed": f"{speed_of(flow):.6g} m/s"}) for cells in CELLS for flow in FLOWS]


def fill(page, runs):
    height = runs["fixed_bed_settling"].figure("height", "twice_centre")
    beds = {LATTICE: (0.09991, 1 - 0.43480, ((0.5044e-3, 1.0),), 0.01)}
    if height:
        beds["sand"] = (height[0], MASS / SAND_DENSITY / SLICE / height[0], SIZES, 0.03)
    for bed, state in beds.items():
        for cells in CELLS:
            for flow in FLOWS:
                add(page, runs[name_of(bed, cells, flow)], bed, cells, flow, state)
        draw(page, runs, bed, state)
    page.note("Slices of 4.7 x 3.1 mm (grains on a lattice) and 3 x 3 mm of the bed of 200 x 15 mm, periodic both ways; 8,988 "
              "grains of the thesis's sand settled in air (Young's modulus 5 MPa), both frozen. Ergun's law is taken for "
              "each size by itself at the mean void fraction; of the settled bed's that varies from cell to cell.")


def add(page, run, bed, cells, flow, state):
    length, solids, sizes, slack = state
    ours, line = run.figure("drop", "pressure_drop"), ergun(sizes, solids, speed_of(flow)) * length / 100
    page.add(f"{bed}, {flow} l/min, {cells * 2 // 5} cells over the bed [mbar]", (ours[0] / 100, None) if ours else None,
             f"{FLOWS[flow]}; {line:.3f} by Ergun's law here, at {1000 * length:.1f} mm and {1 - solids:.4f}",
             (1 - slack) * line, (1 + slack) * line, band=f"within {100 * slack:g} % of Ergun's law here")


def draw(page, runs, bed, state):
    length, solids, sizes, _ = state
    curves = []
    for cells in CELLS:
        found = [(flow, runs[name_of(bed, cells, flow)].figure("drop", "pressure_drop")) for flow in FLOWS]
        found = [(flow, f[0] / 100) for flow, f in found if f]
        curves.append(Curve(f"ours, {cells * 2 // 5} cells", [f for f, _ in found], [p for _, p in found], is_points=True))
    line = [n for n in range(0, 46)]
    curves.append(published("Ergun's law at this bed", line, [ergun(sizes, solids, speed_of(n)) * length / 100 for n in line],
                            is_points=False))
    curves.append(published("measured, falling flow", [10, 20, 30, 40], [2.67, 5.40, 8.20, 10.93], [0.34, 0.33, 0.43, 0.25]))
    page.chart(f"Pressure drop of the fixed bed: {bed}", "flow of the whole vessel [l/min]", "pressure drop [mbar]", curves,
               "Ours and the law at the bed's own void fraction, beside what the thesis measured on its own packing.")

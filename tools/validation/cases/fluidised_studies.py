"""The studies of chapter 5: tables 5.7 to 5.11, and the height of the bed."""

import bed
import study_points
from bed import SOFT
from runs import Plan

TITLE = "Studies of the fluidised bed: cells, drag laws, sides, walls, restitution, sizes, height"
BITS = ("fluidised_bed_column", "mixer")
STUDIES = ("fluidised_bed_cells", "fluidised_bed_restitution", "fluidised_bed_drag", "fluidised_bed_sides", "fluidised_bed_grains",
           "fluidised_bed_rolling", "fluidised_bed_depth_cells")


def plans():
    return [*(Plan(f"fluidised_bed_{height}mm_5", f"thesis/fluidised_bed_{height}mm.yaml", SOFT) for height in (150, 200, 250)),
            *(Plan(f"fluidised_bed_{way}_5", f"thesis/fluidised_bed_{way}.yaml", SOFT) for way in ("ramp", "falling")),
            *(plan for study in STUDIES for plan in study_points.plans(study, SOFT))]


def fill(page, runs):
    for study in STUDIES:
        text = study_points.read(study)
        for label, settings in study_points.points(text):
            run = runs[study_points.plan_of(study, label, settings, SOFT).name]
            for name, given in text["measure"].items():
                page.add(f"{study}, {label}: {name} [{given['unit']}]", study_points.measured(run, given),
                         "[thesis](thesis.md)", why="judged beside the thesis's model on that page")
    rising, falling = runs["fluidised_bed_ramp_5"], runs["fluidised_bed_falling_5"]
    for litres, up, down in ((20, 6.00, 5.40), (30, 8.93, 8.20), (40, 12.13, 10.93), (50, 14.47, 13.40), (75, 15.60, 15.00)):
        for run, text, during, measured in ((rising, "rising", bed.RISING, up), (falling, "falling", bed.FALLING, down)):
            page.add(f"ramp, {text}: pressure drop at {litres} l/min [mbar]", bed.drop_at(run, litres, *during, bed.HALF_SPACING),
                     f"{measured:.2f} (measured)", why="no band is agreed for a ramp")
    bed.draw(page, [rising, falling], {rising.name: bed.RISING, falling.name: bed.FALLING})
    page.note("Pressures of the ramps are means within 2.5 l/min, half of what lies between two measured flows; the pressure of a "
              "floating column of 20 mm swings.")
    page.note("Columns of 20 x 3 mm (of 10 x 15 mm between walls for rolling friction and cells in depth), sand of 5 MPa.")

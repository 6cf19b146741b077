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
            *(Plan(f"fluidised_bed_{way}_5", f"thesis/fluidised_bed_{way}.yaml", SOFT) for way in ("ramp", "wide")),
            Plan(bed.FLOATING, "thesis/fluidised_bed_wide.yaml", {
                **SOFT, "time.end": "4.8 s", f"{bed.AIR}.times": "[0.2, 0.5, 1.3, 4.8 s]", f"{bed.AIR}.factors": "[0, 1, 1, 0.632]",
                "sensors.u_mf.enabled": "false", "references": "[]"}),
            *(point(study, label) for study in STUDIES for label, _ in study_points.points(study_points.read(study)))]


def point(study, label):
    """A point of a study as it is run: in soft sand, and a bed at rest as it has come to rest."""
    settings = dict(study_points.points(study_points.read(study)))[label]
    is_at_rest = study in ("fluidised_bed_cells", "fluidised_bed_drag") and settings[f"{bed.AIR}.speed"] == "0.167 m/s"
    return study_points.plan_of(study, label, settings, bed.AT_REST if is_at_rest else SOFT)


def fill(page, runs):
    for study in STUDIES:
        text = study_points.read(study)
        for label, _ in study_points.points(text):
            run = runs[point(study, label).name]
            for name, given in text["measure"].items():
                page.add(f"{study}, {label}: {name} [{given['unit']}]", study_points.measured(run, given),
                         "[thesis](thesis.md)", why="judged beside the thesis's model on that page", keep=runs.is_done(run))
    for litres, up, down in ((20, 6.00, 5.40), (30, 8.93, 8.20), (40, 12.13, 10.93), (50, 14.47, 13.40), (75, 15.60, 15.00)):
        for name, text, measured in ((bed.RAMP, "rising", up), (bed.falling_at(litres), "falling", down)):
            page.add(f"ramp, {text}: pressure drop at {litres} l/min [mbar]", bed.changing_drop(runs[name], litres),
                     f"{measured:.2f} (measured)", why="no band is agreed for a ramp", keep=runs.is_done(runs[name]))
    bed.draw(page, [runs[name] for name in (bed.RAMP, bed.WIDE, bed.FLOATING)])
    page.note("Pressures of the ramps are means within 2.5 l/min, half of what lies between two measured flows; the pressure of a "
              "floating bed swings. The rising one is a column of the sand's own grains, 20 x 3 mm in plan.")
    page.note("Beds of 100 x 10 mm in plan (15 mm between walls, whole vessels for the heights), in coarse grains of 5 MPa "
              "(fluidised_bed_wide.yaml, fluidised_bed_walls.yaml, fluidised_bed_vessel.yaml).")

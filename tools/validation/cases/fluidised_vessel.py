"""The vessel of the fluidised bed of chapter 5, in coarse grains."""

import bed
from bed import SOFT, VESSEL_SECTION, add_column, add_drops
from runs import Plan

TITLE = "The fluidised bed in its vessel, in coarse grains: falling flow"
BITS = ("fluidised_bed_column", "mixer", "coarse_transfer")
SCENARIO = "thesis/fluidised_bed_vessel.yaml"
PERIODIC = "{grains: periodic, air: periodic}"
OPEN_DEPTH = {"domain.boundaries.front": PERIODIC, "domain.boundaries.back": PERIODIC}
RUNS = {"fluidised_bed_vessel_5": ("walls", SOFT),
        "fluidised_bed_vessel_5_periodic": ("front and back periodic",
                                            {**OPEN_DEPTH, **SOFT, "time.output_every": "0.5 s"})}


def plans():
    return [Plan(folder, SCENARIO, settings) for folder, (_, settings) in RUNS.items()]


def fill(page, runs):
    for folder, (name, _) in RUNS.items():
        add_column(page, runs[folder], name, 0.459, VESSEL_SECTION, has_friction=name == "walls")
        add_drops(page, runs[folder], name)
    bed.draw(page, runs)
    page.note(
        "The whole vessel, 200 x 15 mm in plan with 100 mm of sand, in 46,808 coarse grains that stand for 64 each (docs/theory/coarse_graining.md), "
        "with a tenth of the thesis's stiffness; cells of 5 mm. The flow falls from 80 to 30 l/min within 5 s; pressure drops are means over what lies within 1 l/min of the flow.")
    page.note(
        "Between walls the coarse grains pack looser than the sand does: front and back are 6 of the largest apart, 25 in the vessel, and a loose layer "
        "is as thick as a grain. Between periodic sides there is no such layer; the sand lies between the two. Ergun's law at the bed's own "
        "void fraction is that of a mean over loose layers and dense middle.")

"""A column of the fluidised bed of chapter 5, in the sand's own grains: falling flow."""

import bed
from bed import SOFT, add_column, add_drops
from runs import Plan

TITLE = "The fluidised column: falling flow"
BITS = ("fluidised_bed_column", "mixer")
SCENARIO = "thesis/fluidised_bed_column.yaml"
SECTION, MASS = 20e-3 * 3e-3, 9.18e-3  # [m2], [kg]


def plans():
    return [Plan("fluidised_bed_column_5", SCENARIO, SOFT), Plan("fluidised_bed_column_50", SCENARIO)]


def fill(page, runs):
    for name, folder in (("5 MPa", "fluidised_bed_column_5"), ("50 MPa", "fluidised_bed_column_50")):
        weight = add_column(page, runs[folder], f"{name}, falling", MASS, SECTION)
        add_drops(page, runs[folder], f"{name}, falling")
    bed.draw(page, runs)
    page.note(
        f"A column of the vessel of 200 x 15 mm in plan, 20 x 3 mm with 100 mm of sand, periodic both ways (59,914 grains, weight over section "
        f"{weight:.0f} Pa), with a tenth of the thesis's stiffness. The superficial velocity falls from 0.444 to 0.167 m/s (80 to 30 l/min of the whole "
        f"vessel) within 5 s. Pressure drops are means over what lies within 1 l/min of the falling flow, "
        f"which begins at 80 and ends at 30: there the window is 0.1 s, a few swings of a bed that bubbles.")
    page.note(
        "The stiffness matters little: with the thesis's 50 MPa the column made 42.8 l/min and 0.991 of the weight, with 5 MPa 44.4 l/min and 0.986, both before drag "
        "was given to the air along its tangent (decision 0021). With 50 MPa it takes some 4.5 hours of a processor.")
    page.note(
        "The bed defluidises to a denser packing than the thesis's 0.435 to 0.445, between periodic sides (the vessel has walls 15 mm, "
        "some 30 grains, apart): hence lower velocities. The law at the bed's own void fraction stands beside them, and the whole vessel on "
        "[its own page](fluidised_vessel.md).")

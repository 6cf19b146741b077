"""The fluidised bed of chapter 5, in coarse grains: the whole vessel, and a part of it in finer ones."""

import dataclasses

import bed
from bed import SOFT, WIDE, add_column, add_drops
from runs import Plan

TITLE = "The fluidised bed in coarse grains: falling flow"
BITS = ("fluidised_bed_column", "mixer", "coarse_transfer")
SCENARIO = "thesis/fluidised_bed_vessel.yaml"
PERIODIC = "{grains: periodic, air: periodic}"
OPEN_DEPTH = {"domain.boundaries.front": PERIODIC, "domain.boundaries.back": PERIODIC}


@dataclasses.dataclass(frozen=True)
class Bed:
    name: str
    plan: Plan
    has_friction: bool = False


BEDS = (Bed("walls", Plan("fluidised_bed_vessel_5", SCENARIO, SOFT), has_friction=True),
        Bed("front and back periodic", Plan("fluidised_bed_vessel_5_periodic", SCENARIO, {**OPEN_DEPTH, **SOFT, "time.output_every": "0.5 s"})),
        Bed("100 x 10 mm, periodic, finer grains", Plan(WIDE, "thesis/fluidised_bed_wide.yaml", SOFT)))


def plans():
    return [each.plan for each in BEDS]


def fill(page, runs):
    for each in BEDS:
        add_column(page, runs[each.plan.name], each.name, each.has_friction)
        add_drops(page, runs[each.plan.name], each.name)
    bed.draw(page, runs)
    page.note(
        "100 mm of sand with a tenth of the thesis's stiffness; cells of 5 mm. The whole vessel, 200 x 15 mm in plan, in 46,808 coarse grains that stand "
        "for 64 each (docs/theory/coarse_graining.md), its flow from 80 to 30 l/min within 5 s; 100 x 10 mm of it in 36,984 that stand for 27 each, its flow "
        "from 95 l/min to nothing within 4.6 s, slowly (3 s) from 65 to 35. Pressure drops are means over what lies within 1 l/min of the flow.")
    page.note(
        "Between walls the coarse grains pack looser than the sand does: front and back are 6 of the largest apart, 25 in the vessel, and a loose layer "
        "is as thick as a grain. Between periodic sides there is no such layer; the sand lies between the two. Ergun's law at the bed's own "
        "void fraction is that of a mean over loose layers and dense middle.")
    page.note(
        "A bed much narrower than it is deep comes to rest more densely: [experiments](experiments.md).")

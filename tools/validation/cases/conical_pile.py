"""The conical piles of chapter 4: lifted cylinder and funnel."""

from runs import Plan

TITLE = "The conical pile"
BITS = ("container_walls", "dosta_drum")
SOFT = {"materials.sand.young_modulus": "5 MPa"}


def plans():
    return [Plan("pile_cylinder", "thesis/pile_cylinder.yaml", SOFT),
            Plan("pile_funnel", "thesis/pile_funnel.yaml", SOFT)]


def fill(page, runs):
    page.add("slope, lifted cylinder [deg]", runs["pile_cylinder"].figure("pile", "angle"),
             "33 ± 1.1 (measured), 34.2 (thesis, DEM)", low=31, high=37)
    page.add("slope, funnel [deg]", runs["pile_funnel"].figure("pile", "angle"), "39 ± 1.1 (measured)",
             low=36.4, high=41.6, band="within 6.6 % of the measured one (thesis's own limit)")
    page.note("Cylinder of 20 mm filled 40 mm high, lifted by 10 mm; funnel with an outlet of 6 mm: sizes are ours, "
              "the thesis gives none.")

"""Liberated dust over 4 s by wind and restitution, Figures 6.28 to 6.33."""

import study_points

TITLE = "Dust over 4 s by wind and restitution"
BITS = ("transfer_point", "rare_sizes", "mixer")


def plans():
    """Three seeds of each point."""
    return [plan for plan in study_points.plans("dust_4s")]


def fill(page, runs):
    text = study_points.read("dust_4s")
    for expectation in text["expect"]:
        study_points.add_sign(page, runs, "dust_4s", expectation)
    for label, settings in study_points.points(text):
        run = runs[study_points.plan_of("dust_4s", label, settings).name]
        for name, given in text["measure"].items():
            page.add(f"{label}: {name}", study_points.measured(run, given), "-", why="the thesis shows pictures and signs")

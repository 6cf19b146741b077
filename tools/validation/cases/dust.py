"""Liberated dust over 4 s by wind and restitution, Figures 6.28 to 6.33."""

import study_points
from cases.belt import sign_text

TITLE = "Dust over 4 s by wind and restitution"
BITS = ("transfer_point", "rare_sizes", "mixer")


def plans():
    """Three seeds of each point."""
    return [plan for plan in study_points.plans("dust_4s")]


def fill(page, runs):
    text = study_points.read("dust_4s")
    for expectation in text["expect"]:
        ours = study_points.change(runs, "dust_4s", expectation)
        page.add(f"{sign_text(expectation)}: change over twice its error", ours[0] / max(2 * ours[1], 1e-300) if ours else None,
                 f"{expectation['then']}: {expectation['why']}", low=1.0)
    for label, settings in study_points.points(text):
        run = runs[study_points.plan_of("dust_4s", label, settings).name]
        for name, given in text["measure"].items():
            page.add(f"{label}: {name}", study_points.measured(run, given), "-", why="the thesis shows pictures and signs")

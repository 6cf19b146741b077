"""The hourglass over both frictions of the sand: Table 4.7, Figures 4.9 to 4.14."""

import study_points
from chart import Curve

TITLE = "The hourglass over friction and rolling friction"
BITS = ("container_walls", "mixer")
# The thesis's hourglass, and a small one that tells which way its figures go.
STUDY, SMALL = "hourglass_friction", "hourglass_friction_small"
MU_S, MU_R = "interactions[0].contact.friction", "interactions[0].rolling.friction"


def plans():
    return [plan for study in (SMALL, STUDY) for plan in study_points.plans(study)]


def fill(page, runs):
    for study, begin in ((SMALL, "20 mm wide, "), (STUDY, "")):
        text = study_points.read(study)
        for expectation in text["expect"]:
            study_points.add_sign(page, runs, study, expectation, begin)
        lines = {}
        for label, settings in study_points.points(text):
            run = runs[study_points.plan_of(study, label, settings).name]
            for name, measure in text["measure"].items():
                found = study_points.measured(run, measure)
                page.add(f"{begin}mu_s {settings[MU_S]}, mu_r {settings[MU_R]}: {name} [{measure.get('unit', 's')}]", found, "-",
                         why="the thesis draws contours")
                if found and name == "angle":
                    lines.setdefault(settings[MU_R], []).append((float(settings[MU_S]), found[0]))
        page.chart(f"Slope over friction{', 20 mm wide' if begin else ''}", "mu_s", "slope [deg]",
                   [Curve(f"mu_r {mu_r}", *map(list, zip(*found)), is_points=True) for mu_r, found in lines.items()],
                   "Lines of the small hourglass: its angles say which way they go, and no more." if begin else
                   "The measured 41.6 deg crosses these lines; the measured time tells where.")

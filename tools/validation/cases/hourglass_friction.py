"""The hourglass over both frictions of the sand: Table 4.7, Figures 4.9 to 4.14."""

import study_points
from cases.belt import sign_text
from chart import Curve

TITLE = "The hourglass over friction and rolling friction"
BITS = ("container_walls", "mixer")
STUDY = "hourglass_friction"
MU_S, MU_R = "interactions[0].contact.friction", "interactions[0].rolling.friction"


def plans():
    return study_points.plans(STUDY)


def fill(page, runs):
    text = study_points.read(STUDY)
    for expectation in text["expect"]:
        ours = study_points.change(runs, STUDY, expectation)
        sign = 1 if expectation["then"] == "rises" else -1
        page.add(f"{sign_text(expectation)}: change over twice its error", sign * ours[0] / max(2 * ours[1], 1e-300) if ours else None,
                 f"{expectation['then']}: {expectation['why']}", low=1.0)
    lines = {}
    for label, settings in study_points.points(text):
        run = runs[study_points.plan_of(STUDY, label, settings).name]
        angle = study_points.measured(run, text["measure"]["angle"])
        page.add(f"mu_s {settings[MU_S]}, mu_r {settings[MU_R]}: slope [deg]", angle, "-", why="the thesis draws contours")
        page.add(f"mu_s {settings[MU_S]}, mu_r {settings[MU_R]}: time [s]", study_points.measured(run, text["measure"]["time"]), "-",
                 why="the thesis draws contours")
        if angle:
            lines.setdefault(settings[MU_R], []).append((float(settings[MU_S]), angle[0]))
    page.chart("Slope over friction", "mu_s", "slope [deg]",
               [Curve(f"mu_r {mu_r}", *map(list, zip(*found)), is_points=True) for mu_r, found in lines.items()],
               "The measured 41.6 deg crosses these lines; the measured time tells where.")

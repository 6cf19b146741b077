"""The belt tables of chapter 6 (6.4, 6.6, Figure 6.15) at full resolution: positions of the stream and expected signs."""

import study_points
from chart import Curve, published

TITLE = "The stream off the belt: tables 6.4 and 6.6, Figure 6.15"
BITS = ("transfer_point", "rare_sizes", "mixer")
STUDIES = ("table_6_4_air", "table_6_4_speed", "table_6_6", "table_6_4_inclination", "table_6_4_plate", "table_6_4_rolling",
           "figure_6_15", "table_6_6_air")
# The thesis runs to 1 s; the stream is steady before.
TO_ONE_SECOND = {"time.end": "1 s"}


def plans():
    return [plan for study in STUDIES for plan in study_points.plans(study, TO_ONE_SECOND)]


def fill(page, runs):
    for study in STUDIES:
        for expectation in study_points.read(study).get("expect", []):
            study_points.add_sign(page, runs, study, expectation, f"{study}: ", TO_ONE_SECOND)
    for study in STUDIES:
        add_places(page, runs, study)
    draw(page, runs)
    page.note("Cells of 1.25 mm, 50 MPa, all sizes with dust where the row does not name one size. Bands: the sign that the "
              "thesis shows. " + study_points.RULE)


def add_places(page, runs, study):
    text = study_points.read(study)
    for label, settings in study_points.points(text):
        run = runs[study_points.plan_of(study, label, settings, TO_ONE_SECOND).name]
        ours = study_points.measured(run, text["measure"]["x_140"])
        if study == "table_6_4_air" and label.startswith("with_air") and "600" in label:
            page.add(f"{study}, {label}: median 140 mm below the belt [mm]", ours, "120 to 135 (one grain: 128.1)", 120, 135)
        else:
            page.add(f"{study}, {label}: median 140 mm below the belt [mm]", ours, "-", why="the thesis shows a sign, no number")


def draw(page, runs):
    curves = []
    text = study_points.read("table_6_4_speed")
    for feed in ("1 g/s", "6 g/s"):
        found = []
        for label, settings in study_points.points(text):
            run = runs[study_points.plan_of("table_6_4_speed", label, settings, TO_ONE_SECOND).name]
            place = study_points.measured(run, text["measure"]["x_140"])
            if settings["emitters.feed.mass_flow"] == feed and place:
                found.append((float(settings["bodies.belt.speed"].split()[0]), place[0], place[1] or 0.0))
        curves.append(Curve(f"ours, {feed}", [f[0] for f in found], [f[1] for f in found], [f[2] for f in found], is_points=True))
    page.chart("Where the stream falls, 140 mm below the belt", "belt speed [m/s]", "x - x_A [mm]",
               [*curves, published("throw in vacuum", [0.2, 0.4, 0.6, 0.8], [1e3 * u * (2 * 0.14 / 9.81) ** 0.5 for u in (0.2, 0.4, 0.6, 0.8)],
                                   is_points=False)], "Slow belts carry the sand round the pulley before it leaves.")

"""Chapter 6: the stream off the belt and its dust; the thesis shows signs, and hardly a number."""

import study_points
from cases import belt, dust
from thesis.row import Row, Sign

WHERE = {"table_6_4_air": "Table 6.4, Figures 6.10, 6.11", "table_6_4_speed": "Table 6.4, Figures 6.5 to 6.8",
         "table_6_4_inclination": "Table 6.4", "table_6_4_plate": "Table 6.4", "table_6_4_rolling": "Table 6.4, Figure 6.13",
         "table_6_6": "Table 6.6", "figure_6_15": "Figure 6.15", "dust_4s": "Figures 6.28 to 6.33"}
FEED = "feed's opening and velocity (the thesis gives none)"


def rows(runs):
    out = []
    for study, extra in (*((s, belt.TO_ONE_SECOND) for s in belt.STUDIES), ("dust_4s", None)):
        for expectation in study_points.read(study).get("expect", []):
            out.append(sign(runs, study, expectation, extra))
    return [flight(runs), *out]


def flight(runs):
    """The one number with a band: at 0.8 m/s, level, 6 g/s, the stream falls between a lone grain's flights."""
    name = study_points.plan_of("table_6_6", "base", dict(study_points.points(study_points.read("table_6_6")))["base"],
                                belt.TO_ONE_SECOND).name
    ours = runs[name].figure("stream", "drop_140_mm/median")
    return Row("6.4", "0.8 m/s, 6 g/s: median 140 mm below the belt [mm]", (name,), ours and (1e3 * ours[0], 1e3 * (ours[1] or 0)), None,
               why="120 to 135 by the flight of one grain; the thesis shows a picture", differs=FEED)


def sign(runs, study, expectation, extra):
    ours = study_points.change(runs, study, expectation, extra)
    factor = 1 if expectation["then"] == "rises" else -1
    names = tuple(plan.name for plan in study_points.plans(study, extra))
    shown = names if len(names) < 3 else (names[0], f"... {len(names)} runs")
    return Sign(WHERE[study], belt.sign_text(expectation), shown, ours and (factor * ours[0], ours[1]), expectation["then"], FEED)

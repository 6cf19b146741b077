"""Chapter 6: the stream off the belt and its dust; the thesis shows signs, and hardly a number."""

import study_points
from cases import belt
from thesis.row import Row, Sign

WHERE = {"table_6_4_air": "Table 6.4, Figures 6.10, 6.11", "table_6_4_speed": "Table 6.4, Figures 6.5 to 6.8",
         "table_6_4_inclination": "Table 6.4", "table_6_4_plate": "Table 6.4", "table_6_4_rolling": "Table 6.4, Figure 6.13",
         "table_6_6": "Table 6.6", "figure_6_15": "Figure 6.15", "table_6_6_air": "6.5, Table 6.6", "dust_4s": "Figures 6.28 to 6.33"}
FEED = "feed's opening and velocity (the thesis gives none)"


def rows(runs):
    out = []
    for study, extra in (*((s, belt.TO_ONE_SECOND) for s in belt.STUDIES), ("dust_4s", None)):
        for expectation in study_points.read(study).get("expect", []):
            out.append(sign(runs, study, expectation, extra))
    return [flight(runs), *edges(runs), low_pressure(runs), *carried_back(runs), *out, *loose_dust(runs)]


def flight(runs):
    """The one number with a band: at 0.8 m/s, level, 6 g/s, the stream falls between a lone grain's flights."""
    run = base_of(runs)
    ours = run.figure("stream", "drop_140_mm/median")
    return Row("6.4", "0.8 m/s, 6 g/s: median 140 mm below the belt [mm]", (run.name,), ours and (1e3 * ours[0], 1e3 * (ours[1] or 0)), None,
               why="120 to 135 by the flight of one grain; the thesis shows a picture", differs=FEED)


def base_of(runs):
    settings = dict(study_points.points(study_points.read("table_6_6")))["base"]
    return runs[study_points.plan_of("table_6_6", "base", settings, belt.TO_ONE_SECOND).name]


def edges(runs):
    """Figure 6.9: both edges of the stream at 6 g/s; the outer one depends on the feed's opening, which is ours."""
    run, out = base_of(runs), []
    for drop in (50, 100, 140):
        for quantile, text in ((5, "inner"), (95, "outer")):
            ours = run.figure("stream", f"drop_{drop}_mm/quantile_{quantile}")
            out.append(Row("Figure 6.9", f"{text} edge {drop} mm below the belt [mm]", (run.name,),
                           ours and (1e3 * ours[0], 1e3 * (ours[1] or 0.0)), why="the thesis shows a picture", differs=FEED))
    return out


def low_pressure(runs):
    """Minima of p/rho in the eddies beside the stream, in still air."""
    run = base_of(runs)
    ours = run.figure("suction", "place_1/pressure_over_density")
    return Row("6.5", "lowest pressure beside the stream, p/rho [m2/s2]", (run.name,), ours, thesis=-0.4,
               why="a model's value, of a picture", differs=FEED)


def carried_back(runs):
    """The thesis's pictures show 10 um grains that follow the returning belt, and no coarse ones among them."""
    run, out = base_of(runs), []
    for size in (10, 300, 420, 500, 600):
        ours = run.figure("carry_back", f"class_{size}_um/grams_per_tonne")
        out.append(Row("6.5", f"{size} um grains that ride back below the belt [g/t]", (run.name,), ours,
                       why="the thesis shows a picture: dust alone", differs=FEED))
    return out


def loose_dust(runs):
    """Dust off the stream after 4 s, each case as the mean over those of its seeds that have ended."""
    text, found = study_points.read("dust_4s"), {}
    for label, plan in study_points.labelled("dust_4s"):
        found.setdefault(label.split(" ")[0], []).append(runs[plan.name])
    out = []
    for case, seeds in found.items():
        ended = [one for run in seeds if (one := study_points.measured(run, text["measure"]["loose"])) is not None]
        ours = study_points.mean_over_seeds(ended) if ended else None
        ours = ours and (1e6 * ours[0], 1e6 * (ours[1] or 0.0))
        differs = FEED if len(ended) in (0, len(seeds)) else f"{FEED}; {len(ended)} of {len(seeds)} seeds"
        out.append(Row("Figures 6.28 to 6.33", f"dust off the stream, {case} [mg/m3]", tuple(run.name for run in seeds[:1]) + (f"... {len(seeds)} runs",),
                       ours, why="the thesis shows pictures", differs=differs))
    return out


def sign(runs, study, expectation, extra):
    names = tuple(study_points.plan_of(study, *point, extra).name for point in study_points.points_of(study, expectation))
    shown = names if len(names) < 3 else (names[0], f"... {len(names)} runs")
    return Sign(WHERE[study], study_points.sign_text(expectation), shown, study_points.signed_change(runs, study, expectation, extra),
                expectation["then"], FEED)

"""Chapter 3: one sphere that settles."""

from cases.settling_b import TEN_CATE
from effects import Change
from thesis.row import Row, Sign, difference

WATER = 0.158
# Printed errors of the thesis's largest velocity; which way they are it does not say.
THESIS_ERROR = {1: 0.011, 2: 0.016, 3: 0.037, 4: 0.046}
OURS = "own disturbance taken off (our default), the voidage's inner fraction of 0.9"


def rows(runs):
    return [*water(runs), *oil(runs), *resolved(runs), *orders(runs)]


def water(runs):
    """A1 is held against the analytic velocity of one sphere: 0.158 m/s with Abraham's coefficient (the thesis prints 0.160)."""
    table = (("Figure 3.3", "centre, D/dx 0.5", "settling_a1_voidage_centre_False", 0.150),
             ("Figure 3.3", "divided, D/dx 0.5", "settling_a1_voidage_divided_False", 0.152),
             ("Figure 3.4", "big particle, D/dx 2", "settling_a1_cells_d_dx_2", 0.152),
             ("Figure 3.4", "big particle, D/dx 4", "settling_a1_cells_d_dx_4", 0.152),
             ("Figure 3.6", "Gidaspow, divided", "settling_a1_drag_gidaspow", 0.160 * 0.999),
             ("Figure 3.6", "Di Felice, divided", "settling_a1_drag_di_felice", 0.152),
             ("Figure 3.6", "Koch and Hill, divided (worst of the three)", "settling_a1_drag_koch_hill", None),
             ("Figure 3.8", "divided, W/D 5 (not valid there)", "settling_a1_box_w_d_5", None),
             ("Figure 3.8", "divided, W/D 10", "settling_a1_box_w_d_10", None),
             ("Figure 3.8", "divided, W/D 20", "settling_a1_box_w_d_20", None),
             ("Figure 3.8", "big particle, D/dx 4, W/D 5", "settling_a1_box_w_d_5_big", 0.152),
             ("Figure 3.8", "big particle, D/dx 4, W/D 10", "settling_a1_box_w_d_10_big", 0.152))
    differs = {"settling_a1_voidage_centre_False": "none (own disturbance not taken off)",
               "settling_a1_voidage_divided_False": "none (own disturbance not taken off)"}
    out = [Row(where, f"A1, {what}: end velocity [m/s]", (name,), runs[name].figure("fall", "velocity"), WATER, 0.003, model,
               why="an analytic value; judged on its page by 0.150 to 0.165",
               differs=differs.get(name, "own disturbance taken off (our default)")) for where, what, name, model in table]
    return out + [row for rule in ("divided", "centre", "big particle") for row in through_the_surface(runs, rule)]


def through_the_surface(runs, rule):
    name = "air_to_water" if rule == "divided" else f"air_to_water_{rule.replace(' ', '_')}"
    fall, case = runs[name], "A2 to A1" + ("" if rule == "divided" else f", {rule}")
    return [
        Row("Figure 3.9", f"{case}: speed at the surface [m/s]", (name,), fall.figure("fall", "level_30_mm/velocity"),
            0.539, 0.0, 0.539 * 1.05, why="other authors' values, 5 % off at most", differs="step of the fluid's properties"),
        Row("Figure 3.9", f"{case}: near the floor after [s]", (name,), fall.figure("fall", "level_1_mm/time"),
            0.207, 0.0, 0.2, why="one sphere's value; judged on its page by 0.19 to 0.22", differs="step of the fluid's properties")]


def oil(runs):
    out = []
    for number, error in THESIS_ERROR.items():
        # The thesis reads 0.0373 of B1 off the curve, 3.6 % above the table.
        measured = 0.0373 if number == 1 else TEN_CATE[number][0] * TEN_CATE[number][1]
        model = 0.0369 if number == 1 else measured * (1 - error)
        for kind, what, differs in (("gidaspow", "Gidaspow", OURS),
                                    ("with", "Abraham, lubrication", "drag law, lubrication")):
            run = runs[f"settling_b{number}_{kind}"]
            for figure, text in (("largest/velocity", "largest velocity"), ("level_60_mm/velocity", "velocity at 60 mm")):
                out.append(Row("Figure 3.5" if number == 1 else "Figure 3.10", f"B{number}, {what}: {text} [m/s]", (run.name,),
                               run.figure("fall", figure), measured, round(0.05 * measured, 4), model,
                               why="the uncertainty of the measurement, 5 %, stands for it", differs=differs))
    for name, what, where, model in (("settling_b1_d_dx_2", "D/dx 2", "Figure 3.5", None),
                                     ("settling_b1_d_dx_6", "D/dx 6", "Figure 3.5", 0.0369),
                                     ("settling_b1_di_felice", "Di Felice", "Figure 3.7", None),
                                     ("settling_b1_interval_10", "coupling interval 10", "Table 3.3", 0.0389),
                                     ("settling_b1_gidaspow", "coupling interval 100", "Table 3.3", 0.0386)):
        out.append(Row(where, f"B1, {what}: largest velocity [m/s]", (name,), runs[name].figure("fall", "largest/velocity"),
                       0.0373, 0.0019, model, why="the uncertainty of the measurement, 5 %, stands for it",
                       differs=OURS))
    return out + [cost_of_interval(runs)]


def resolved(runs):
    """The thesis's reference of these cases is a resolved sphere, too; it is held against the measured velocity alone."""
    return [Row("Figure 3.5" if number == 1 else "Figure 3.10", f"B{number}, resolved sphere, D/dx 12: largest velocity [m/s]", (f"resolved_b{number}",),
                runs[f"resolved_b{number}"].figure("fall", "largest/velocity"), share * infinite, round(0.05 * share * infinite, 4),
                why="the uncertainty of the measurement, 5 %, stands for it", differs="none")
            for number, (infinite, share) in TEN_CATE.items()]


def cost_of_interval(runs):
    fine, coarse = (runs[f"settling_b1_{k}"] for k in ("interval_10", "gidaspow"))
    ours = None
    if fine.is_finished() and coarse.is_finished():
        ours = Change(fine.summary["cpu_s"] / coarse.summary["cpu_s"] - 1)
    return Sign("Table 3.3", "B1: computing time of coupling interval 10 over that of 100, less 1", (fine.name, coarse.name), ours,
                "19.1 (42,489 s over 2112 s)")


def orders(runs):
    """What chapter 3 says is further off than what, without a number."""
    water, oil = (("fall", "velocity"), WATER), (("fall", "largest/velocity"), 0.0373)
    table = (("Figure 3.6", "A1: error of Koch and Hill less that of Di Felice [m/s]", "settling_a1_drag_koch_hill", "settling_a1_drag_di_felice",
              water, "the worst of the three"),
             ("Figure 3.8", "A1, divided: error at W/D 5 less that at W/D 10 [m/s]", "settling_a1_box_w_d_5", "settling_a1_box_w_d_10",
              water, "not valid at 5"),
             ("Figure 3.7", "B1: error of Di Felice less that of Gidaspow [m/s]", "settling_b1_di_felice", "settling_b1_gidaspow",
              oil, "Gidaspow is better"))
    return [Sign(where, what, (worse, better), further_off(runs[worse], runs[better], *held), shown,
                 "own disturbance taken off (our default)") for where, what, worse, better, held, shown in table]


def further_off(worse, better, figure, truth):
    found = [run.figure(*figure) for run in (worse, better)]
    if None in found:
        return None
    off = [(abs(value - truth), error) for value, error in found]
    return difference(off[1], off[0])

"""Chapter 4: hourglass, conical piles, rectangular container."""

import study_points
from cases import hourglass, hourglass_friction, rectangular_container
from runs import read_table
from thesis.row import Row, Sign, difference

SOFT = "E 5 MPa in place of 50"
OURS = "sizes (the thesis gives none)"


def rows(runs):
    return [*discharge(runs), *friction(runs), *piles(runs), *container(runs), *computing_times(runs)]


def discharge(runs):
    out = []
    for row in read_table("thesis_hourglass.csv"):
        neck, mass = int(row["neck_mm"]), int(row["mass_g"])
        for kind in hourglass.KINDS:
            for stiff in ("", "_50MPa") if mass == 25 else ("",):
                out += hourglass_rows(runs, row, neck, mass, kind, stiff)
    return out


def hourglass_rows(runs, row, neck, mass, kind, stiff):
    name = hourglass.name_of(neck, mass, kind) + stiff
    run, label = runs[name], f"{neck} mm, {mass} g, {kind}"
    time, angle = float(row["measured_time_s"]), float(row["measured_angle_deg"])
    # Table 4.8 prints the measured angles once more as the model's; their error says how far they were, not which way.
    model = float(row["dem_angle_deg"]) if kind == "dry" else angle * (1 + float(row["cfddem_angle_error_percent"]) / 100)
    model_time = float(row["dem_time_s" if kind == "dry" else "cfddem_time_s"])
    differs = "none" if stiff else SOFT
    return [Row("Tables 4.2, " + ("4.6" if kind == "dry" else "4.9"), f"{label}: discharging time [s]", (name,),
                run.figure("outlet", "duration"), time, 0.1, model_time, 0.077, differs=differs),
            Row("Tables 4.2, " + ("4.5" if kind == "dry" else "4.8"), f"{label}: angle of repose [deg]", (name,),
                run.figure("crater", "angle"), angle, 1.1, model, 0.057, differs=differs)]


def friction(runs):
    """Signs of the contours, in a small hourglass; the pair that meets both measured figures is the calibration's (4.4.2)."""
    study = hourglass_friction.SMALL
    names = [plan.name for plan in study_points.plans(study)]
    out = []
    for expectation in study_points.read(study)["expect"]:
        out.append(Sign("Table 4.7, Figures 4.9 to 4.14", study_points.sign_text(expectation), (names[0], f"... {len(names)} runs"),
                        study_points.signed_change(runs, study, expectation), expectation["then"], f"20 mm and 6.1 g in place of 32 and 25, {SOFT}"))
    return out


def piles(runs):
    return [Row("4.5", "pile, lifted cylinder: angle [deg]", ("pile_cylinder",), runs["pile_cylinder"].figure("pile", "angle"),
                33, 1.1, 34.2, 0.066, differs=f"{OURS}, {SOFT}"),
            Row("4.5", "pile, funnel: angle [deg]", ("pile_funnel",), runs["pile_funnel"].figure("pile", "angle"), 39, 1.1, None,
                0.066, differs=f"{OURS}, {SOFT}")]


def container(runs):
    out, found = [], {}
    for row in read_table("thesis_table_4_10_rectangular_container.csv"):
        n = int(row["W_over_D"])
        for kind in ("walls", "periodic"):
            name = f"container_{kind}" + ("" if n == 4 else f"_{n}")
            found[kind, n] = runs[name].figure("slope", "angle")
            measured = float(row["AoR_exp_deg"]) if kind == "walls" and row["AoR_exp_deg"] else None
            out.append(Row("Table 4.10", f"container, W/D {n}, {kind}: angle [deg]", (name,), found[kind, n], measured,
                           1.1 if measured else 0.0, float(row["AoR_wall_deg" if kind == "walls" else "AoR_periodic_deg"]),
                           0.057 if measured else None, why="nothing was measured", differs=f"{OURS}, {SOFT}"))
    for n in rectangular_container.WIDE:
        for place in rectangular_container.PLACES:
            run = runs[rectangular_container.name_of("walls", n)]
            out.append(Row("4.6", f"container, W/D {n}, walls, {place}: angle [deg]", (run.name,), run.figure(f"slope_{place}", "angle"),
                           why="the thesis shows pictures of it", differs=f"{OURS}, {SOFT}"))
    narrow, wide = found["walls", 4], found["walls", 32]
    ours = difference(wide, narrow) if narrow and wide else None
    return out + [Sign("Table 4.10", "container, walls: angle at W/D 4 less that at 32 [deg]", ("container_walls", "container_walls_32"),
                       ours, "6.0", f"{OURS}, {SOFT}")]


def computing_times(runs):
    """Seconds of a processor, the thesis's on its machine and ours on ours; nothing is judged."""
    out = []
    for row in read_table("thesis_table_4_10_rectangular_container.csv"):
        n = int(row["W_over_D"])
        for kind, column in (("walls", "cpu_wall_s"), ("periodic", "cpu_periodic_s")):
            run = runs[f"container_{kind}" + ("" if n == 4 else f"_{n}")]
            out.append(Row("Table 4.10", f"container, W/D {n}, {kind}: computing time [s]", (run.name,),
                           (run.summary["cpu_s"], None) if run.is_finished() else None, thesis=float(row[column]),
                           why="another machine", differs=f"{OURS}, {SOFT}"))
    return out

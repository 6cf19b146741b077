"""Case A1 of chapter 3: one grain of sand that sinks in water."""

import study_points
from chart import Curve, published

TITLE = "Case A1: one grain of sand that sinks in water, one factor at a time"
BITS = ("settling_a1",)
FACTORS = (
    ("drag law", "settling_a1_drag",
     {"gidaspow": "within 0.1 % (thesis)", "di_felice": "0.143 (one sphere), thesis 5 % off"}),
    ("void fraction", "settling_a1_voidage",
     {"centre False": "0.150 (thesis)", "divided False": "0.152 (thesis)", "big_particle False": "0.152 (thesis)"}),
    ("W/D", "settling_a1_box", {}),
    ("place in the cell", "settling_a1_place", {}),
    ("coupling interval", "settling_a1_interval", {}),
    ("own disturbance taken off", "settling_a1_correction", {}),
    ("D/dx", "settling_a1_cells", {}))


def plans():
    return [plan for _, study, _ in FACTORS for plan in study_points.plans(study)]


def fill(page, runs):
    for factor, study, known in FACTORS:
        for label, plan in study_points.labelled(study):
            ours = runs[plan.name].figure("fall", "velocity")
            band = {"low": 0.150, "high": 0.165} if expects_law_of_one_sphere(label) else {
                "why": "a law of beds, or Di Felice's, which do not tend to one sphere's drag here"}
            page.add(f"{factor}: {shown(label)}", ours, known.get(label, "0.155 to 0.158 (one sphere)"), unit="m/s", **band)
    draw(page, runs)
    page.note("Base: Gidaspow, divided, D/dx 0.5, W/D 20, coupling interval 100 (2 us); the grain's own disturbance is taken off "
              "as by default (`self_disturbance: auto`) unless the row says that it is not. The band is that of the sphere let go in air (0.150 to 0.165 m/s).")
    page.note("What fails without the correction is the grain's own doing, not the law's: it sees the solids and the flow that "
              "it makes itself, the more the larger the share of its volume in its own cell: all of it with `centre`, a quarter "
              "with `divided` on an edge of cells. With it the rule of the void fraction hardly matters "
              "([own disturbance](../theory/own_disturbance.md)); from some two cells to a grain on it fills the cells it "
              "lies in and is no unresolved one.")


def draw(page, runs):
    curves = []
    for label in ("gidaspow", "di_felice", "koch_hill", "abraham"):
        run = runs[f"settling_a1_drag_{label}"]
        column = next((c for c in (run.series() or [{}])[0] if "velocity" in c and c.startswith("fall/")), None)
        if column:
            curves.append(Curve(label, *run.curve(column)))
    page.chart("Speed of the grain by drag law", "time [s]", "speed [m/s]",
               [*curves, published("one sphere, Abraham", [0, 0.26], [0.158, 0.158], is_points=False)],
               "The line is the end velocity of one sphere with Abraham's drag coefficient.")


def shown(name):
    """The two levels of the correction in words."""
    return name.replace(" True", ", own disturbance taken off").replace(" False", ", own disturbance not taken off")


def expects_law_of_one_sphere(name):
    return not any(law in name for law in ("di_felice", "koch_hill", "beetstra"))

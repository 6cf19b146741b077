"""Chapter 5: the fluidised bed."""

import bed
from bed import LITRES_PER_MINUTE, VESSEL_SECTION
from cases.fluidised_studies import point
from effects import Change
from runs import read_table
from thesis.row import Row, Sign, difference

PRESSURE_ERROR = 0.3  # [mbar], of a measured one
FLOATING = 56  # [l/min], minimum fluidisation as the thesis measures it
COLUMN = "column of 20 x 3 mm, periodic, of the vessel's 200 x 15; E 5 MPa in place of 50"
WIDE = "100 x 10 mm, periodic, of the vessel's 200 x 15; coarse grains that stand for 27; E 5 MPa in place of 50"
AT_REST = f"{WIDE}; begins with the bed that has come to rest"
WALLS = "100 mm of the vessel's 200 along x; coarse grains that stand for 27; E 5 MPa in place of 50"
VESSEL = "front and back periodic; coarse grains that stand for 64; E 5 MPa in place of 50"
NO_LIMIT = "the thesis names none for pressures"


def rows(runs):
    return [*fluidisation(runs), *falling(runs), *ramp(runs), *tables(runs), *signs(runs)]


def pressure_in_flow():
    """Uncertainty [l/min] of a flow that is read off a pressure: 0.3 mbar over the slope with which the last fixed bed's falls."""
    low, high = (next(row for row in read_table("thesis_bed_pressure_100mm.csv")
                      if row["branch"] == "decreasing" and abs(float(row["air_flow_l_min"]) - litres) < 1) for litres in (45, 50))
    rise, run = (float(high[key]) - float(low[key]) for key in ("corrected_pressure_mbar", "air_flow_l_min"))
    return PRESSURE_ERROR * run / rise


def fluidisation(runs):
    """Minimum fluidisation: where lines of pressure cross, and of height, of which nobody tells how sure it is."""
    out = []
    for table in read_table("thesis_table_5_6_minimum_fluidisation.csv"):
        height = table["bed_height_mm"]
        each = runs[bed.WIDE if height == "100" else f"fluidised_bed_{height}mm_5"]
        for key, text in (("by_pressure", "pressure"), ("by_height", "height")):
            ours = each.figure("u_mf", f"falling/{key}")
            scale = VESSEL_SECTION * LITRES_PER_MINUTE
            out.append(Row("Table 5.6", f"{height} mm: minimum fluidisation by {text} [l/min]", (each.name,),
                           ours and (ours[0] * scale, (ours[1] or 0.0) * scale), float(table[key]),
                           pressure_in_flow() if key == "by_pressure" else 0.0,
                           why="the thesis's two ways differ by 11 %", differs=WIDE if height == "100" else VESSEL))
    return out


def model_at(litres, sides):
    """The thesis's own pressure drop [mbar] of the bed of 100 mm while the flow falls: that of Table 5.9, which is held against the
    falling branch of Table A.4 at six of its flows; None at the others. A bed that floats has one pressure, whichever way its flow goes:
    from FLOATING on these are the model's on the rising branch, too."""
    return next((float(row[f"dp_{sides}_mbar"]) for row in read_table("thesis_table_5_9_boundary.csv")
                 if abs(float(row["flow_l_min"]) - litres) < 0.5), None)


def falling(runs):
    """The whole vessel, at four flows; every flow of the wide bed is among those of `ramp`."""
    out = []
    for litres, measured, std in ((80, 15.20, 0.34), (50, 13.40, 0.34), (40, 10.93, 0.34), (30, 8.20, 0.43)):
        name = "fluidised_bed_vessel_5"
        out.append(Row("Table A.4", f"100 mm, falling, {litres} l/min: pressure drop [mbar]", (name,), bed.drop_at(runs[name], litres, 1.0),
                       measured, max(std, PRESSURE_ERROR), model_at(litres, "wall"), why=NO_LIMIT,
                       differs="coarse grains that stand for 64; E 5 MPa in place of 50"))
    return out


def ramp(runs):
    """Every flow of Table A.4, on ramps that rise from rest and fall back to it, in a few seconds each."""
    out = []
    for row in read_table("thesis_bed_pressure_100mm.csv"):
        litres = float(row["air_flow_l_min"])
        if litres == 0:
            continue
        is_rising = row["branch"] == "increasing"
        text, name, differs = ("rising", bed.RAMP, COLUMN) if is_rising else ("falling, ramp", bed.falling_at(litres), WIDE)
        out.append(Row("Table A.4", f"100 mm, {text}, {litres:g} l/min: pressure drop [mbar]", (name,), bed.changing_drop(runs[name], litres),
                       float(row["corrected_pressure_mbar"]), max(float(row["std_mbar"]), PRESSURE_ERROR),
                       None if is_rising and litres < FLOATING else model_at(litres, "periodic"), why=NO_LIMIT, differs=differs))
    return out


def signs(runs):
    """The penetration effect, one size against the distribution, and one cell in depth against five."""
    up, down = (bed.changing_drop(runs[name], 40) for name in (bed.RAMP, bed.WIDE))
    grains = {label: runs[point("fluidised_bed_grains", label).name] for label in ("distribution", "mono_0_6_mm")}
    fine, coarse = (grains[label].figure("u_mf", "falling/by_pressure") for label in ("distribution", "mono_0_6_mm"))
    return [Sign("Table A.4", "penetration: rising less falling flow at 40 l/min [mbar]", (bed.RAMP, bed.WIDE),
                 Change(up[0] - down[0]) if up and down else None, "+1.2 (measured)", f"rising: {COLUMN}; falling: {WIDE}"),
            Sign("5.5", "minimum fluidisation, 0.6 mm less distribution [m/s]",
                 (grains["distribution"].name, grains["mono_0_6_mm"].name),
                 difference(fine, coarse) if fine and coarse else None, "rises (1.35 by Ergun)", WIDE),
            *depth(runs)]


def depth(runs):
    out = []
    for speed, litres in (("0.167 m/s", 30), ("0.444 m/s", 80)):
        (one_name, one), (five_name, five) = (drop_of(runs, "fluidised_bed_depth_cells", f"{kind} {speed}") for kind in ("one", "five"))
        out.append(Row("5.4", f"{litres} l/min: pressure drop with five cells in depth over that with one", (one_name, five_name),
                       (five[0] / one[0], None) if one and five else None, thesis=1.0, why="the thesis says that one is enough",
                       differs=WALLS))
    return out


def drop_of(runs, study, label):
    """(name, pressure drop [mbar]) of a point of a study."""
    run = runs[point(study, label).name]
    ours = run.figure("drop", "pressure_drop")
    return run.name, ours and (ours[0] / 100, None if ours[1] is None else ours[1] / 100)


def beside_walls(runs, litres):
    """(name, pressure drop [mbar]) between walls 15 mm apart, while the flow falls; at 80 l/min of a bed that floats there for 0.7 s, for a
    falling flow hurries through."""
    if litres == 80:
        return drop_of(runs, "fluidised_bed_rolling", "0.3")
    run = runs[point("fluidised_bed_sides", "walls").name]
    return run.name, bed.drop_at(run, litres, *bed.CHANGING[bed.WIDE], bed.HALF_SPACING)


def without_walls(runs, litres):
    run = runs[bed.falling_at(litres)]
    return run.name, bed.changing_drop(run, litres)


def tables(runs):
    out = []

    def add(where, what, found, measured, model, differs=WIDE):
        name, ours = found
        out.append(Row(where, f"{what}: pressure drop [mbar]", (name,), ours, measured, PRESSURE_ERROR, model, why=NO_LIMIT, differs=differs))

    for label, mm, model in (("dx_20_mm", 20, 5.12), ("dx_10_mm", 10, 6.72), ("dx_6_7_mm", 6.7, 7.51), ("dx_5_mm", 5, 8.10),
                             ("dx_4_mm", 4, 8.15), ("dx_3_3_mm", 3.3, 8.16)):
        add("Table 5.7", f"30 l/min, cells of {mm} mm", drop_of(runs, "fluidised_bed_cells", label), 8.2, model, AT_REST)
    for row in read_table("thesis_table_5_8_drag.csv"):
        speed = {"30": "0.167 m/s", "80": "0.444 m/s"}[row["flow_l_min"]]
        for law, column in (("gidaspow", "Gidaspow"), ("di_felice", "DiFelice"), ("koch_hill", "KochHill")):
            add("Table 5.8", f"{row['flow_l_min']} l/min, {law}", drop_of(runs, "fluidised_bed_drag", f"{law} {speed}"),
                float(row["dp_exp_mbar"]), float(row[f"dp_{column}_mbar"]),
                AT_REST if row["flow_l_min"] == "30" else WIDE)
    for row in read_table("thesis_table_5_9_boundary.csv"):
        litres, measured = int(row["flow_l_min"]), float(row["dp_exp_mbar"])
        add("Table 5.9", f"{litres} l/min, walls", beside_walls(runs, litres), measured, float(row["dp_wall_mbar"]), WALLS)
        add("Table 5.9", f"{litres} l/min, periodic", without_walls(runs, litres), measured, float(row["dp_periodic_mbar"]))
    for row in read_table("thesis_table_5_10_5_11.csv"):
        model, measured = float(row["dp_mbar"]), float(row["dp_exp_mbar"])
        if row["table"] == "5.10":
            add("Table 5.10", f"80 l/min, rolling friction on the walls {row['mu_r_pw']}",
                drop_of(runs, "fluidised_bed_rolling", f"{float(row['mu_r_pw']):g}"), measured, model, WALLS)
        else:
            add("Table 5.11", f"50 l/min, restitution {row['e']}", drop_of(runs, "fluidised_bed_restitution", f"{float(row['e']):g}"),
                measured, model)
    return out

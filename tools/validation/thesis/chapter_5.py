"""Chapter 5: the fluidised bed."""

import bed
import study_points
from bed import LITRES_PER_MINUTE, SOFT, VESSEL_SECTION
from runs import read_table
from thesis.row import Row, Sign

COLUMN = "column of 20 x 3 mm, periodic, of the vessel's 200 x 15; E 5 MPa in place of 50"
FLOATING = 56  # [l/min], minimum fluidisation as the thesis measures it
NO_LIMIT = "the thesis names none for pressures"


def rows(runs):
    return [*fluidisation(runs), *falling(runs), *ramp(runs), *tables(runs), *signs(runs)]


def fluidisation(runs):
    out = []
    for table in read_table("thesis_table_5_6_minimum_fluidisation.csv"):
        height = table["bed_height_mm"]
        each = runs["fluidised_bed_column_5" if height == "100" else f"fluidised_bed_{height}mm_5"]
        for key, text in (("by_pressure", "pressure"), ("by_height", "height")):
            ours = each.figure("u_mf", f"falling/{key}")
            scale = VESSEL_SECTION * LITRES_PER_MINUTE
            out.append(Row("Table 5.6", f"{height} mm: minimum fluidisation by {text} [l/min]", (each.name,),
                           ours and (ours[0] * scale, (ours[1] or 0.0) * scale), float(table[key]), 0.0,
                           why="the thesis's two ways differ by 11 %", differs=COLUMN))
    return out


def model_at(litres, sides):
    """The thesis's own pressure drop [mbar] of the bed of 100 mm while the flow falls: that of Table 5.9, which is held against the
    falling branch of Table A.4 at six of its flows; None at the others. A bed that floats has one pressure, whichever way its flow goes:
    from FLOATING on these are the model's on the rising branch, too."""
    return next((float(row[f"dp_{sides}_mbar"]) for row in read_table("thesis_table_5_9_boundary.csv")
                 if abs(float(row["flow_l_min"]) - litres) < 0.5), None)


def falling(runs):
    out = []
    for litres, measured, std in ((80, 15.20, 0.34), (50, 13.40, 0.34), (40, 10.93, 0.34), (30, 8.20, 0.43)):
        for name, sides, differs in (("fluidised_bed_column_5", "periodic", COLUMN),
                                     ("fluidised_bed_vessel_5", "wall", "coarse grains that stand for 64; E 5 MPa in place of 50")):
            out.append(Row("Table A.4", f"100 mm, falling, {litres} l/min: pressure drop [mbar]", (name,),
                           bed.drop_at(runs[name], litres, 1.0), measured, max(std, 0.3), model_at(litres, sides), why=NO_LIMIT,
                           differs=differs))
    return out


def ramp(runs):
    """Every flow of Table A.4, on ramps that rise from rest and fall back to it, in a few seconds each."""
    out = []
    for row in read_table("thesis_bed_pressure_100mm.csv"):
        litres = float(row["air_flow_l_min"])
        if litres == 0:
            continue
        is_rising = row["branch"] == "increasing"
        text, run, times, differs = (("rising", runs["fluidised_bed_ramp_5"], bed.RISING, COLUMN) if is_rising else
                                     ("falling, ramp", runs["fluidised_bed_falling_5"], bed.FALLING, COLUMN + "; cells of 2.5 mm"))
        out.append(Row("Table A.4", f"100 mm, {text}, {litres:g} l/min: pressure drop [mbar]", (run.name,), bed.drop_at(run, litres, *times, bed.HALF_SPACING),
                       float(row["corrected_pressure_mbar"]), max(float(row["std_mbar"]), 0.3),
                       None if is_rising and litres < FLOATING else model_at(litres, "periodic"), why=NO_LIMIT, differs=differs))
    return out


def signs(runs):
    """The penetration effect, one size against the distribution, and one cell in depth against five."""
    up, down = (bed.drop_at(runs[name], 40, *times, bed.HALF_SPACING)
                for name, times in (("fluidised_bed_ramp_5", bed.RISING), ("fluidised_bed_falling_5", bed.FALLING)))
    grains = {label: runs[study_points.plan_of("fluidised_bed_grains", label, settings, SOFT).name]
              for label, settings in study_points.points(study_points.read("fluidised_bed_grains"))}
    fine, coarse = (grains[label].figure("u_mf", "falling/by_pressure") for label in ("distribution", "mono_0_6_mm"))
    return [Sign("Table A.4", "penetration: rising less falling flow at 40 l/min [mbar]", ("fluidised_bed_ramp_5", "fluidised_bed_falling_5"),
                 (up[0] - down[0], None) if up and down else None, "+1.2 (measured)", COLUMN),
            Sign("5.5", "minimum fluidisation, 0.6 mm less distribution [m/s]",
                 (grains["distribution"].name, grains["mono_0_6_mm"].name),
                 (coarse[0] - fine[0], (coarse[1] or 0) + (fine[1] or 0)) if fine and coarse else None, "rises (1.35 by Ergun)", COLUMN),
            *depth(runs)]


def depth(runs):
    out = []
    for speed, litres in (("0.167 m/s", 30), ("0.444 m/s", 80)):
        (one_name, one), (five_name, five) = (drop_of(runs, "fluidised_bed_depth_cells", f"{kind} {speed}") for kind in ("one", "five"))
        out.append(Row("5.4", f"{litres} l/min: pressure drop with five cells in depth over that with one", (one_name, five_name),
                       (five[0] / one[0], None) if one and five else None, thesis=1.0, why="the thesis says that one is enough",
                       differs="10 mm of the vessel's 200 along x; E 5 MPa in place of 50"))
    return out


def drop_of(runs, study, wanted):
    """(name, pressure drop [mbar]) of the point of a study whose label is `wanted`."""
    for label, settings in study_points.points(study_points.read(study)):
        if label == wanted:
            run = runs[study_points.plan_of(study, label, settings, SOFT).name]
            ours = run.figure("drop", "pressure_drop")
            return run.name, ours and (ours[0] / 100, (ours[1] or 0.0) / 100)
    raise KeyError(f"{study}: no point is called {wanted}")


def tables(runs):
    out = []

    def add(where, what, study, label, measured, model, differs=COLUMN):
        name, ours = drop_of(runs, study, label)
        out.append(Row(where, f"{what}: pressure drop [mbar]", (name,), ours, measured, 0.3, model, why=NO_LIMIT, differs=differs))

    for label, mm, model in (("dx_20_mm", 20, 5.12), ("dx_10_mm", 10, 6.72), ("dx_6_7_mm", 6.7, 7.51), ("dx_5_mm", 5, 8.10),
                             ("dx_4_mm", 4, 8.15), ("dx_3_3_mm", 3.3, 8.16)):
        add("Table 5.7", f"30 l/min, cells of {mm} mm", "fluidised_bed_cells", label, 8.2, model)
    for row in read_table("thesis_table_5_8_drag.csv"):
        speed = {"30": "0.167 m/s", "80": "0.444 m/s"}[row["flow_l_min"]]
        for law, column in (("gidaspow", "Gidaspow"), ("di_felice", "DiFelice"), ("koch_hill", "KochHill")):
            add("Table 5.8", f"{row['flow_l_min']} l/min, {law}", "fluidised_bed_drag", f"{speed} {law}", float(row["dp_exp_mbar"]),
                float(row[f"dp_{column}_mbar"]))
    for row in read_table("thesis_table_5_9_boundary.csv"):
        speed = {"10": 0.0556, "30": 0.167, "50": 0.278, "60": 0.333, "70": 0.389, "80": 0.444}[row["flow_l_min"]]
        for kind, column in (("walls", "dp_wall_mbar"), ("periodic", "dp_periodic_mbar")):
            add("Table 5.9", f"{row['flow_l_min']} l/min, {kind}", "fluidised_bed_sides", f"{kind} {speed} m/s",
                float(row["dp_exp_mbar"]), float(row[column]), COLUMN + ("; walls 3 mm apart" if kind == "walls" else ""))
    for row in read_table("thesis_table_5_10_5_11.csv"):
        model, measured = float(row["dp_mbar"]), float(row["dp_exp_mbar"])
        if row["table"] == "5.10":
            add("Table 5.10", f"80 l/min, rolling friction on the walls {row['mu_r_pw']}", "fluidised_bed_rolling",
                f"{float(row['mu_r_pw']):g}", measured, model, "10 mm of the vessel's 200 along x; E 5 MPa in place of 50")
        else:
            add("Table 5.11", f"50 l/min, restitution {row['e']}", "fluidised_bed_restitution", f"{float(row['e']):g}", measured, model)
    return out

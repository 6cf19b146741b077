"""The hourglass of chapter 4: both necks, three masses, dry and in air."""

from chart import Curve, published
from runs import Plan, read_table

TITLE = "The hourglass: 5 and 8 mm; 25, 50 and 75 g; dry and in air"
BITS = ("container_walls", "mixer")
SOFT = {"materials.sand.young_modulus": "5 MPa"}
NECKS, MASSES, KINDS = (5, 8), (25, 50, 75), ("dry", "air")
# Largest errors that the thesis allows itself.
TIME_LIMIT, ANGLE_LIMIT = 0.077, 0.057


def name_of(neck, mass, kind):
    return f"hourglass_{neck}mm" + ("" if mass == 25 else f"_{mass}g") + ("" if kind == "dry" else "_air")


def plans():
    soft = [Plan(name_of(neck, mass, kind), f"thesis/{name_of(neck, mass, kind)}.yaml", SOFT)
            for mass in MASSES for neck in NECKS for kind in KINDS]
    stiff = [Plan(name_of(neck, 25, kind) + "_50MPa", f"thesis/{name_of(neck, 25, kind)}.yaml")
             for neck in NECKS for kind in KINDS]
    return soft + stiff


def time_of_share(run, share):
    """Time [s] from the first grain until `share` of all that leave have left, of a finished run."""
    rows = [(r["time [s]"], r["outlet/number [1]"]) for r in run.series()]
    if not rows:
        return None
    begin = max((t for t, number in rows if number == 0), default=0.0)
    return next(t for t, number in rows if number >= share * rows[-1][1]) - begin


def share_at(run, time):
    """Share of all grains that leave which have left `time` [s] after the first, of a finished run."""
    rows = [(r["time [s]"], r["outlet/number [1]"]) for r in run.series()]
    if not rows:
        return None
    begin = max((t for t, number in rows if number == 0), default=0.0)
    return max(number for t, number in rows if t <= begin + time) / rows[-1][1]


def fill(page, runs):
    for row in read_table("thesis_hourglass.csv"):
        for kind in KINDS:
            for stiff in ("", "_50MPa") if row["mass_g"] == "25" else ("",):
                add(page, row, kind, stiff, runs[name_of(int(row["neck_mm"]), int(row["mass_g"]), kind) + stiff])
    draw(page, runs)
    page.note("Measured with air. Friction 0.52 / 0.30 dry, 0.49 / 0.30 in air, as calibrated there. Sand of 5 MPa in "
              "place of 50 unless the row says 50 MPa: a step three times as long.")
    page.note("The time is that of the last grain through the hole. The last hundredth trickles grain by grain: what an "
              "eye or a scale calls the end comes before, hence the row of 99 %.")


def add(page, row, kind, stiff, run):
    label = f"{row['neck_mm']} mm, {row['mass_g']} g, {kind}" + (", 50 MPa" if stiff else "")
    time, angle = float(row["measured_time_s"]), float(row["measured_angle_deg"])
    model_time = row["dem_time_s" if kind == "dry" else "cfddem_time_s"]
    model_angle = f"{row['dem_angle_deg']}" if kind == "dry" else f"{row['cfddem_angle_error_percent']} % off"
    page.add(f"{label}: time [s]", run.figure("outlet", "duration"), f"{time} ± 0.1 (measured), {model_time} (thesis)",
             (1 - TIME_LIMIT) * time, (1 + TIME_LIMIT) * time, band="within 7.7 % of the measured one")
    page.add(f"{label}: time of 99 % [s]", time_of_share(run, 0.99), "-", why="nothing published by this definition")
    page.add(f"{label}: share of the grains that have left at the measured time", share_at(run, time), "1 (all)",
             why="what the last grains make of the time of the last one")
    page.add(f"{label}: slope [deg]", run.figure("crater", "angle"), f"{angle} ± 1.1 (measured), {model_angle} (thesis)",
             (1 - ANGLE_LIMIT) * angle, (1 + ANGLE_LIMIT) * angle, band="within 5.7 % of the measured one")


def draw(page, runs):
    curves = []
    for run in runs:
        times, passed = run.curve("outlet/number [1]")
        curves.append(Curve(run.name, times, [n / max(passed[-1], 1) for n in passed] if passed else []))
    page.chart("Share of the grains that leave", "time [s]", "passed / passed at the end", curves,
               "The grains settle first: the plug goes when they are at rest.")
    ends = [(row, runs[name_of(int(row["neck_mm"]), int(row["mass_g"]), kind)].figure("outlet", "duration"), kind)
            for row in read_table("thesis_hourglass.csv") for kind in KINDS]
    found = [(int(r["mass_g"]), f[0]) for r, f, _ in ends if f]
    table = read_table("thesis_hourglass.csv")
    page.chart("Discharging time", "mass [g]", "time [s]",
               [Curve("ours", [m for m, _ in found], [t for _, t in found], is_points=True),
                *(published(f"measured, {neck} mm", *zip(*((int(r["mass_g"]), float(r["measured_time_s"]))
                                                           for r in table if r["neck_mm"] == str(neck))))
                  for neck in NECKS)],
               "Measured times with air, of both necks.")

"""The rectangular container of chapter 4: the slope between walls and between periodic sides."""

from chart import Curve, published
from runs import Plan, read_table

TITLE = "The rectangular container: walls and periodic"
BITS = ("container_walls", "container_periodic")
SOFT = {"materials.sand.young_modulus": "5 MPa"}
KINDS, WIDTHS = ("walls", "periodic"), (4, 6, 8, 12, 24, 32)


def name_of(kind, width):
    return f"container_{kind}" + ("" if width == 4 else f"_{width}")


# Where front, back and middle of the wide ones are told apart: slices of 1 mm at the walls, a third in the middle.
PLACES, WIDE = ("wall", "middle"), (12, 24, 32)


def sensor_at(place, width):
    """A slope of a part of the container, `width` [mm] deep."""
    first, last = (0, 1) if place == "wall" else (width / 3, 2 * width / 3)
    return (f"{{model: angle_of_repose, form: planar, direction: [1, 0, 0], min: [0, {first:.4g}, 0 mm], "
            f"max: [40, {last:.4g}, 90 mm]}}")


def plan_of(kind, n):
    places = {f"sensors.slope_{p}": sensor_at(p, 0.5 * n) for p in PLACES} if kind == "walls" and n in WIDE else {}
    return Plan(name_of(kind, n), f"thesis/{name_of(kind, n)}.yaml", {"time.end": "0.9 s", **SOFT, **places})


def plans():
    return [plan_of(kind, n) for n in WIDTHS for kind in KINDS]


def fill(page, runs):
    table = {int(row["W_over_D"]): row for row in read_table("thesis_table_4_10_rectangular_container.csv")}
    angles = {}
    for kind in KINDS:
        for n in WIDTHS:
            angles[kind, n] = add_width(page, kind, n, runs[name_of(kind, n)].figure("slope", "angle"), table[n])
    for n in WIDE:
        for place in PLACES:
            page.add(f"slope, W/D50 = {n}, walls, {'at the front wall' if place == 'wall' else 'in the middle'} [deg]",
                     runs[name_of("walls", n)].figure(f"slope_{place}", "angle"), "-", why="the thesis shows pictures of it")
    narrow, wide = angles["walls", 4], angles["walls", 32]
    page.add("walls: narrowest less widest [deg]", narrow[0] - wide[0] if narrow and wide else None,
             "6.0 (thesis, DEM)", low=3.0)
    flat = [angles["periodic", n][0] for n in WIDTHS if angles["periodic", n]]
    page.add(f"periodic: spread over {len(flat)} widths [deg]", max(flat) - min(flat) if len(flat) > 1 else None,
             "0.8 (thesis, DEM)", high=1.5)
    draw(page, angles, table)
    page.note("Container 40 mm long, filled 30 mm high: sizes are ours, the thesis gives none.")


def add_width(page, kind, n, ours, row):
    text = f"{row['AoR_wall_deg' if kind == 'walls' else 'AoR_periodic_deg']} (thesis, DEM)"
    what = f"slope, W/D50 = {n}, {kind} [deg]"
    if kind == "walls" and row["AoR_exp_deg"]:
        measured = float(row["AoR_exp_deg"])
        return page.add(what, ours, f"{text}, {measured} ± 1.1 (measured)", low=0.943 * measured, high=1.057 * measured,
                        band="within 5.7 % of the measured one (thesis's own limit)")
    return page.add(what, ours, text, why="nothing was measured; another code's figure is no truth")


def draw(page, angles, table):
    curves = []
    for kind, column in (("walls", "AoR_wall_deg"), ("periodic", "AoR_periodic_deg")):
        found = [(n, angles[kind, n]) for n in WIDTHS if angles[kind, n]]
        curves.append(Curve(f"{kind}, ours", [n for n, _ in found], [a[0] for _, a in found],
                            [a[1] or 0.0 for _, a in found], is_points=True))
        curves.append(published(f"{kind}, thesis, DEM", WIDTHS, [float(table[n][column]) for n in WIDTHS], is_points=False))
    measured = [(n, float(table[n]["AoR_exp_deg"])) for n in WIDTHS if table[n]["AoR_exp_deg"]]
    curves.append(published("measured", *zip(*measured), errors=[1.1] * len(measured)))
    page.chart("Slope over the width of the container", "W / D50", "slope [deg]", curves,
               "Ours with one standard error beside table 4.10.")

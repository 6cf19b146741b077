"""Two silos after Dosta et al. (2024): rate of discharge."""

from chart import Curve, published
from runs import Plan, read_table

TITLE = "Silo discharge after Dosta et al. (2024)"
BITS = ("dosta_drum", "container_walls")
SOFT = {"materials.m1.young_modulus": "10 MPa"}
# Orifice: text, rate [1/s], grains left 2 s after opening.
SIZES = {"large": ("24200 (MUSEN), 24500 (LIGGGHTS), 23200 ± 5 % (mean)", 24200.0, 51156),
         "small": ("7740 (MUSEN)", 7740.0, 84522)}


def plans():
    return [Plan(f"dosta_silo_{size}", f"thesis/dosta_silo_{size}.yaml", SOFT) for size in SIZES]


def fill(page, runs):
    rates = {size: add_size(page, runs[f"dosta_silo_{size}"], size) for size in SIZES}
    is_known = all(rates.values())
    page.add("rate, large over small", rates["large"][0] / rates["small"][0] if is_known else None, "3.10 ± 0.06",
             low=3.04, high=3.16)
    table = read_table("dosta_silo_counts.csv")
    curves = []
    for size in SIZES:
        times, passed = runs[f"dosta_silo_{size}"].curve("outlet/number [1]")
        curves.append(Curve(f"{size}, ours", [t - 0.5 for t in times], [100000 - n for n in passed]))
        theirs = [(float(r["time_s"]), float(r[f"{size}_M1_musen"])) for r in table if r[f"{size}_M1_musen"]]
        curves.append(published(f"{size}, MUSEN", *zip(*theirs), is_points=False))
    page.chart("Grains left in the silo", "time after opening [s]", "grains", curves, "Ours beside the published counts.")
    page.note("Own packing: grains rained on a plug that goes at 0.5 s; grains a hundred times softer than the paper's, steel "
              "walls as stiff as its.")


def add_size(page, run, size):
    published_rates, rate, left = SIZES[size]
    ours = run.figure("outlet", "number_rate")
    page.add(f"{size} orifice: rate [1/s]", ours, published_rates, low=0.93 * rate, high=1.07 * rate,
             band=f"within 7 % of {rate:g}")
    rows = [r for r in run.series() if r["time [s]"] >= 2.5 - 1e-9]
    page.add(f"{size} orifice: grains left 2 s after opening", 100000 - rows[0]["outlet/number [1]"] if rows else None,
             f"{left:g} (MUSEN)", why="follows from the rate, which is judged")
    ratio = None
    if run.is_finished():
        # Linear in time: the rate of the first half second of full flow beside that of the last.
        passed = {round(r["time [s]"], 3): r["outlet/number [1]"] for r in run.series()}
        at = lambda t: passed[min(passed, key=lambda s: abs(s - t))]
        ratio = (at(2.5) - at(2.0)) / (at(1.3) - at(0.8))
    page.add(f"{size} orifice: rate at 2 s over rate at 0.5 s", ratio, "1.00 (MUSEN)", why="linear, but no tolerance is published")
    return ours

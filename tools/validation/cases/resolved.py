"""Cases B1 to B4 of chapter 3 with a resolved sphere (ten Cate et al. 2002)."""

from cases.settling_b import TEN_CATE
from chart import Curve, published
from runs import Plan

TITLE = "Resolved spheres: cases B1 to B4, a sphere of 15 mm in silicone oil"
BITS = ("settling_a1",)


def plans():
    return [Plan(f"resolved_b{number}", f"thesis/settling_b{number}_resolved.yaml") for number in TEN_CATE]


def fill(page, runs):
    for number, (infinite, share) in TEN_CATE.items():
        run = runs[f"resolved_b{number}"]
        largest = share * infinite
        page.add(f"B{number}: largest velocity [m/s]", run.figure("fall", "largest/velocity"), f"{largest:.4f} (measured)",
                 low=0.95 * largest, high=1.05 * largest, band="within 5 % of the measured one")
        page.add(f"B{number}: velocity 60 mm over the floor [m/s]", run.figure("fall", "level_60_mm/velocity"), f"{largest:.4f} (largest measured)",
                 why="the measured velocity there is not tabulated here")
        page.add(f"B{number}: gap of 15 mm passed after [s]", run.figure("fall", "level_15_mm/time"), "-", why="no table of it here")
    draw(page, runs)
    page.note("The sphere is 12 cells across; neither a drag law nor a rule of the void fraction is asked "
              "([theory](../theory/resolved.md)). The same cases with an unresolved sphere: [settling_b.md](settling_b.md).")
    page.note("Cubic arrays of spheres in Stokes flow (Zick and Homsy 1982) are a test, V-ARRAY in tests/verification/resolved; its figures "
              "stand in the theory.")


def draw(page, runs):
    curves = []
    for number, (infinite, share) in TEN_CATE.items():
        run = runs[f"resolved_b{number}"]
        column = next((c for c in (run.series() or [{}])[0] if "velocity" in c and c.startswith("fall/")), None)
        if column:
            curves.append(Curve(f"B{number}", *run.curve(column)))
        curves.append(published(f"B{number}, largest measured", [0, 4], [share * infinite] * 2, is_points=False))
    page.chart("Speed of the sphere", "time [s]", "speed [m/s]", curves, "Lines: largest measured velocities (ten Cate et al. 2002).")

"""Discharge of smooth spheres through holes of several sizes, beside Beverloo's correlation."""

import math

from chart import Curve, published
from runs import Plan

TITLE = "Discharge through a hole after Beverloo"
BITS = ("container_walls", "dosta_drum")
HOLES = (6, 7, 8, 10)
SCENARIO = "verification/beverloo.yaml"
# As the name says, friction is small: what it does, and the height of the filling.
VARIANTS = (("beverloo_8_rough", {f"interactions[{n}].contact.friction": "0.4" for n in (0, 1)}),
            ("beverloo_8_low", {"emitters.bed.mass": "14.1 g"}))


def plans():
    holes = [Plan(f"beverloo_{hole}", SCENARIO,
                  {"bodies.floor.hole_radius": f"{hole / 2:g} mm", "bodies.plug.radius": f"{hole / 2:g} mm",
                   "sensors.outlet.hole": f"{hole} mm"}) for hole in HOLES]
    return holes + [Plan(name, SCENARIO, settings) for name, settings in VARIANTS]


def fill(page, runs):
    points = []
    for hole in HOLES:
        run = runs[f"beverloo_{hole}"]
        rate = run.figure("outlet", "rate")
        page.add(f"rate over Beverloo (C 0.58, k 1.4), hole of {hole} d", run.figure("outlet", "rate_over_beverloo"), "1",
                 why="C and k are a range, judged below")
        if rate:
            points.append((hole * 1e-3, *rate))
    add_fits(page, points if len(points) == len(HOLES) else None)
    add_variants(page, runs)
    draw(page, points)


def add_fits(page, points):
    exponent = k = c = None
    if points:
        exponent, k = (with_error(lambda r, n=n: fit_power(r)[n], points) for n in (0, 1))
        c = sum(w / (1500 * math.sqrt(9.81) * (h - 1.4e-3) ** 2.5) for h, w, _ in points) / len(points)
    page.add("exponent of (D_0 - 1.4 d)", exponent, "2.5", low=2.35, high=2.65)
    page.add("C with k = 1.4, bulk density 1500 kg/m3", c, "0.55 to 0.65", low=0.55, high=0.65)
    page.add("k with the exponent 2.5", k, "1.2 to 1.6", low=1.2, high=1.6)


def add_variants(page, runs):
    middle = runs["beverloo_8"].figure("outlet", "rate")
    rough, low = (runs[name].figure("outlet", "rate") for name, _ in VARIANTS)
    page.add("friction 0.4 in place of 0.2: rate over that of smooth spheres", rough[0] / middle[0] if rough and middle else None,
             "-", why="nothing published for these spheres")
    page.add("filled to 1.5 diameters in place of 2: rate over that of 2", low[0] / middle[0] if low and middle else None,
             "1", low=0.95, high=1.05)


def draw(page, points):
    line = [6e-3 + 1e-4 * n for n in range(41)]
    page.chart("Rate over the hole", "hole [mm]", "rate [g/s]",
               [Curve("ours", [1e3 * h for h, _, _ in points], [1e3 * w for _, w, _ in points],
                      [1e3 * (e or 0.0) for _, _, e in points], is_points=True),
                published("Beverloo, C 0.58, k 1.4, 1500 kg/m3", [1e3 * h for h in line],
                          [1e3 * 0.58 * 1500 * math.sqrt(9.81) * (h - 1.4e-3) ** 2.5 for h in line], is_points=False)],
               "Ours with one standard error.")


def with_error(figure, points):
    """A figure of points (x, y, error of y) and the error that theirs make."""
    plain = [(x, y) for x, y, _ in points]
    value, squares = figure(plain), 0.0
    for n, (x, y, error) in enumerate(points):
        moved = [*plain[:n], (x, y + error), *plain[n + 1:]]
        squares += (figure(moved) - value) ** 2
    return value, math.sqrt(squares)


def fit_power(points):
    """Exponent of the rate over (D_0 - 1.4 d), and k where the exponent is 2.5; d = 1 mm."""
    x = [math.log(h - 1.4e-3) for h, _ in points]
    y = [math.log(w) for _, w in points]
    n, sx, sy = len(points), sum(x), sum(y)
    slope = ((n * sum(a * b for a, b in zip(x, y)) - sx * sy) /
             (n * sum(a * a for a in x) - sx * sx))
    # W^(2/5) = A (D_0 - k d): a straight line.
    u = [h for h, _ in points]
    v = [w ** 0.4 for _, w in points]
    su, sv = sum(u), sum(v)
    tilt = (n * sum(a * b for a, b in zip(u, v)) - su * sv) / (n * sum(a * a for a in u) - su * su)
    return slope, -(sv / n - tilt * su / n) / tilt / 1e-3

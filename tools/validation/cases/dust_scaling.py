"""Scalings that a model of dust is held against: the air that an enclosed chute draws in."""

import math

import study_points
from chart import Curve, published
from induced_air import SIDE, anderson, balance

TITLE = "Scalings of dust and of the air that it moves with"
BITS = ("mixer", "small_hopper")

CHUTE = "chute_air"
LEVELS = {"load R": {"load_3_kg_s": 3, "base": 10, "load_30_kg_s": 30}, "fall S": {"fall_1_m": 1, "base": 2, "fall_4_m": 4},
          "size D": {"size_14_mm": 0.014, "base": 0.02, "size_28_mm": 0.028, "size_40_mm": 0.04}}
UNITS, EXPONENTS = {"load R": "kg/s", "fall S": "m", "size D": "m"}, {"load R": 1 / 3, "fall S": 2 / 3, "size D": -1 / 3}
NO_SLIP = {f"domain.boundaries.{side}.air": "{model: no_slip}" for side in ("left", "right", "front", "back")}


def plans():
    return study_points.plans(CHUTE) + [study_points.plan_of(CHUTE, f"{label} no_slip", {**given, **NO_SLIP})
                                        for label, given in points_of(CHUTE).items() if label in LEVELS["fall S"]]


def points_of(study):
    return dict(study_points.points(study_points.read(study)))


def run_of(runs, study, label, more=""):
    return runs[study_points.plan_of(study, f"{label} {more}".strip(), {}).name]


def power(x, y):
    """(exponent, its standard error) of a power law through points."""
    u, v = [math.log(n) for n in x], [math.log(n) for n in y]
    across, up = sum(u) / len(u), sum(v) / len(v)
    spread = sum((a - across) ** 2 for a in u)
    slope = sum((a - across) * (b - up) for a, b in zip(u, v)) / spread
    left = sum((b - up - slope * (a - across)) ** 2 for a, b in zip(u, v))
    return slope, math.sqrt(left / (len(u) - 2) / spread) if len(u) > 2 else None


def exponent(points):
    """Of (x, y) points; None while one is missing."""
    return power(*zip(*points)) if points and all(y for _, y in points) else None


def air_of(runs, label, more=""):
    found = run_of(runs, CHUTE, label, more).figure("air", "superficial_velocity")
    return found[0] if found else None


def add_chute(page, runs):
    for name, levels in LEVELS.items():
        points = [(x, air_of(runs, label)) for label, x in levels.items()]
        given, key = EXPONENTS[name], name.split()[0]
        x = [v for v, u in points if u]
        single = exponent([(v, balance(**{key: v})) for v in x])
        page.add(f"chute: exponent of the induced air over the {name}", exponent(points), f"{given:.3f}: Anderson's rule",
                 round(given - 0.15, 3), round(given + 0.15, 3))
        page.chart(f"Air drawn into an enclosed chute over the {name}", f"{name} [{UNITS[name]}]", "Q/A_u [m/s]",
                   [Curve("ours", x, [u for _, u in points if u], is_points=True),
                    published("Anderson's rule", x, [anderson(**{key: v}) for v in x], is_points=False),
                    published("balance of forces, one dimension", x, [balance(**{key: v}) for v in x], is_points=False)],
                   f"The balance of forces by itself has the exponent {single[0]:.2f} here." if single else "")
    base = air_of(runs, "base")
    page.add("chute: induced air at 10 kg/s, 2 m and 20 mm over the rule's", base / anderson() if base else None,
             f"1: {anderson() * SIDE**2:.3f} m3/s", 0.5, 2)
    page.add("chute: the same over the balance of forces", base / balance() if base else None,
             f"1: {balance() * SIDE**2:.3f} m3/s", 0.8, 1.25)
    page.add("chute: exponent over the fall S, air that sticks to the walls, cells of 50 mm",
             exponent([(x, air_of(runs, label, "no_slip")) for label, x in LEVELS["fall S"].items()]), "0.667",
             why="an experiment: what coarse cells make of the walls' friction")
    page.note(CHUTE_NOTE)


CHUTE_NOTE = """**Chute.** The rule is Anderson's (1964), in use as the exhaust volume of transfer points: Q = 10 A_u (R S^2/D)^(1/3) in ft3/min,
ft2, short tons/h and ft. The balance of forces lets single grains fall through a uniform flow, with Schiller and Naumann's drag, against one
velocity head (`tools/validation/induced_air.py`); it has the rule's exponents because the air comes to move a third as fast as the grains arrive.
Walls that the air sticks to, in cells of 50 mm with an eddy viscosity, have a friction of some 0.2 of a velocity head per width where a
smooth duct has 0.02: the study leaves it out (slip), and says beside it what it would do."""


def fill(page, runs):
    add_chute(page, runs)

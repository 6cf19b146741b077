"""Scalings that a model of dust is held against: plume, enclosed chute, drop through wind."""

import math
import typing

import study_points
from chart import Curve, published
from induced_air import SIDE, anderson, balance
from runs import ROOT, Plan

TITLE = "Scalings of dust and of the air that it moves with"
BITS = ("mixer", "small_hopper", "dust_field")
READS_FRAMES = True
TAKES_FINISHED_RUNS = True

CHUTE = "chute_air"
LEVELS = {"load R": {"load_3_kg_s": 3, "base": 10, "load_30_kg_s": 30}, "fall S": {"fall_1_m": 1, "base": 2, "fall_4_m": 4},
          "size D": {"size_14_mm": 0.014, "base": 0.02, "size_28_mm": 0.028, "size_40_mm": 0.04}}
UNITS, EXPONENTS = {"load R": "kg/s", "fall S": "m", "size D": "m"}, {"load R": 1 / 3, "fall S": 2 / 3, "size D": -1 / 3}
NO_SLIP = {f"domain.boundaries.{side}.air": "{model: no_slip}" for side in ("left", "right", "front", "back")}


PLUME = "dust/plume.yaml"
# Sand falls through small eddies: its plume is disturbed as slowly as its own largest eddies turn.
SLOWER = 2.5
TIMES = study_points.read_file(ROOT / "scenarios" / PLUME)["domain"]["boundaries"]["top"]["air"]["times"]
AS_GRAINS = {"emitters.sand.enabled": "true", "dust.field.sources.fall.begin": "1 h"}


def times_of_disturbance(pace, digits):
    return {"domain.boundaries.top.air.times": str([round(pace * t, digits) for t in TIMES])}


SAND = {**AS_GRAINS, "domain.min": "[-0.75, -0.75, -2 m]", "fluid.cells": "[60, 60, 200]", "time.end": "13 s", "time.checkpoint_every": "13 s",
        **times_of_disturbance(SLOWER, 3)}
# The plume of the scenario in ten times its size and B/z: its speeds, (B/z)^(1/3), are 2.15 times as large, its times 4.6, the flow that
# disturbs it 215. It falls several times faster than its sand settles.
TALL_SAND = {**AS_GRAINS, "domain.min": "[-7.5, -7.5, 0 m]", "domain.max": "[7.5, 7.5, 30 m]",
             "domain.boundaries.top.air.min": "[-2, -2, 30 m]", "domain.boundaries.top.air.max": "[0, 0, 30 m]",
             "domain.boundaries.top.air.flow": "8.6 m3/s", **times_of_disturbance(4.6, 2),
             "dust.field.sources.fall.min": "[-2, -2, 29.25 m]", "dust.field.sources.fall.max": "[2, 2, 30 m]",
             "emitters.sand.min": "[-2, -2, 29.9 m]", "emitters.sand.max": "[2, 2, 29.9 m]", "emitters.sand.mass_flow": "2 kg/s",
             "emitters.sand.diameters": "[10 mm]", "materials.sand.coarse_graining": "100", "time.expected_speed": "1.5 m/s",
             "time.fluid_step": "46 ms", "time.output_every": "0.69 s", "time.end": "60.03 s", "time.checkpoint_every": "60.03 s"}
SLOWLY = {**TALL_SAND, **times_of_disturbance(8, 2), "time.fluid_step": "45 ms", "time.output_every": "0.9 s", "time.end": "99 s",
          "time.checkpoint_every": "99 s"}
COARSE_PLUME = {"fluid.cells": "[40, 40, 80]", "time.fluid_step": "15 ms"}


class Plume(typing.NamedTuple):
    """A run of the plume and where it is looked at, in depths below its source [m]: turbulent, half way, above the floor."""
    text: str
    settings: dict
    turbulent: float
    middle: float
    below: float
    height: float = 3.0       # m, that it falls through
    mass_flow: float = 0.02   # kg/s
    first_fall: float = 0.6   # m/s: how fast it reaches the floor and settles there; means begin by then
    why: str = ""             # it is not judged


PLUMES = {"plume": Plume("dust of 10 um as a field", {}, 1.2, 2.0, 2.8),
          "plume_sand_tall": Plume("sand of 100 um as grains, 30 m", TALL_SAND, 12.0, 20.0, 28.0, 30.0, 2.0, 1.3),
          "plume_sand_tall_slowly": Plume("sand of 100 um as grains, 30 m, disturbed more slowly", SLOWLY, 12.0, 20.0, 28.0, 30.0, 2.0, 1.3,
                                          "an experiment: what the pace of the disturbance does"),
          "plume_sand": Plume("sand of 100 um as grains", SAND, 2.0, 3.4, 4.8, 5.0),
          "plume_coarse": Plume("dust as a field, cells of 37.5 mm", COARSE_PLUME, 1.2, 2.0, 2.8,
                                why="an experiment: what fewer cells across the source do")}
WIND, SPEEDS, KNOWN = "slug_wind", (1, 2, 4, 6), 2  # m/s; the speed that is calibrated at
DROP = "drop_height_and_flow"
DROPS = {"height of fall": ({"height_0.5_m": 0.5, "base": 1, "height_2_m": 2}, "m", 1.25),
         "mass flow": ({"flow_0.5_kg_s": 0.5, "base": 2, "flow_8_kg_s": 8}, "kg/s", -0.5)}
SHEAR = {"dust.liberation": "{model: shear, emission_coefficient: 0.001}"}
LONG_FALL = {"emitters.slug.min": "[-100, -100, 1500 mm]", "emitters.slug.max": "[100, 100, 1700 mm]"}
MIDDLE_FALL = {"emitters.slug.min": "[-100, -100, 750 mm]", "emitters.slug.max": "[100, 100, 950 mm]"}
SILT = {"materials.stone.dust_load": "[0.1 %, 0.3 %, 0.5 %]"}
WHOLE_SILT = {**SILT, "dust.liberation.emission_coefficient": "0.001"}
FAR_OFF = {**WHOLE_SILT, **LONG_FALL, "domain.max": "[5.2, 0.3, 2 m]", "fluid.cells": "[140, 15, 50]", "time.end": "9 s",
           "time.checkpoint_every": "9 s"}
# Of each what it is, its settings, and why it is not judged; the first one has two numbers fitted to AP-42, the judged ones with the whole silt one.
SLUGS = {"": ("0.6 m", {}, None),
         "whole_silt": ("1.5 m, the whole silt", {**WHOLE_SILT, **LONG_FALL}, None),
         "whole_silt_low": ("0.75 m, the whole silt", {**WHOLE_SILT, **MIDDLE_FALL}, None),
         "long_fall": ("1.5 m", LONG_FALL, "an experiment: what the speed of a longer fall does"),
         "silt": ("0.6 m, the whole silt", SILT, "an experiment: does it matter that what lies loose is soon gone?")}
AP42_AT_KNOWN = 0.74 * 1.6 * (KNOWN / 2.2) ** 1.3 / (0.5 / 2) ** 1.4  # g/t finer than 30 um, at a moisture of 0.5 %


def plans():
    return ([Plan(name, PLUME, plume.settings) for name, plume in PLUMES.items()]
            + study_points.plans(CHUTE) + variants(CHUTE, "no_slip", NO_SLIP, LEVELS["fall S"])
            + study_points.plans(DROP) + variants(DROP, "shear", SHEAR, DROPS["mass flow"][0])
            + [plan for more, (_, given, _) in SLUGS.items()
               for plan in (variants(WIND, more, given, [wind(u) for u in SPEEDS]) if more else study_points.plans(WIND))]
            + variants(WIND, "far_off", FAR_OFF, [wind(1), wind(KNOWN)]))


def variants(study, name, settings, labels):
    """Points of a study with something else changed in all of them."""
    return [study_points.plan_of(study, f"{label} {name}", {**given, **settings}) for label, given in points_of(study).items()
            if label in labels]


def wind(u):
    return f"wind_{u}_m_s"


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


def flow_of(run, seen):
    """(z, Q/B^(1/3)) of the levels of a plume, from the source down; empty where it was not run."""
    if not run.is_finished():
        return []
    import plume  # needs numpy and h5py, as only a page of finished runs does
    depth, flow, _ = plume.flow(run.folder, seen.height / seen.first_fall)
    strength = 9.81 * seen.mass_flow / 1.2  # m4/s3
    return [(z, q / strength ** (1 / 3)) for z, q in zip(depth, flow) if seen.height / 30 < z]


def spread_of(run, seen):
    """Root mean square of the grains' distance from the axis over that of the downward flow; None where it was not run."""
    if not run.is_finished():
        return None
    import plume
    return plume.grain_spread(run.folder, seen.height / seen.first_fall, seen.turbulent, seen.below)


def draw_plumes(page, title, levels):
    """`levels` as flow_of gives them, by name of the plume."""
    curves = [Curve(PLUMES[name].text, [z for z, _ in part], [q for _, q in part]) for name, part in levels.items()]
    far = sorted({z for name, part in levels.items() for z, _ in part if PLUMES[name].turbulent <= z <= PLUMES[name].below})
    page.chart(title, "height of fall z [m]", "Q/B^(1/3) [m^(5/3)]",
               [*curves, *(published(f"{c} z^(5/3)", far, [c * z ** (5 / 3) for z in far], is_points=False) for c in (0.11, 0.17))],
               "Downward flow of the mean over time, where it is above a twentieth of the fastest of its level.")


def add_plume(page, runs):
    found = {name: flow_of(runs[name], seen) for name, seen in PLUMES.items()}
    for name, seen in PLUMES.items():
        text, turbulent, middle, below, why = seen.text, seen.turbulent, seen.middle, seen.below, seen.why or None
        part = [(z, q) for z, q in found[name] if turbulent <= z <= below]
        page.add(f"plume, {text}: exponent of the flow over the height, {turbulent} to {below} m", exponent(part), "1.667 (Morton, Taylor and Turner 1956)",
                 *(() if why else (1.467, 1.867)), why=why)
        page.add(f"plume, {text}: C, mean of the levels", sum(q / z ** (5 / 3) for z, q in part) / len(part) if part else None,
                 "0.14 to 0.16 measured; 0.115 to 0.164 for an entrainment coefficient of 0.10 to 0.13",
                 *(() if why else (0.11, 0.17)), why=why)
        for low, high in ((turbulent, middle), (middle, below)):
            page.add(f"plume, {text}: exponent from {low} to {high} m alone", exponent([(z, q) for z, q in part if low <= z <= high]), "1.667",
                     why="shows whether the plume has developed")
        if AS_GRAINS.items() <= seen.settings.items():
            page.add(f"plume, {text}: their distance from the axis over that of the flow, {turbulent} to {below} m",
                     spread_of(runs[name], seen), "above 1: heat and smoke in a plume", why="an experiment: do the grains go where the air goes?")
    tall = {name: found[name] for name in ("plume_sand_tall", "plume_sand_tall_slowly")}
    draw_plumes(page, "Air that a stream of fines draws in", {name: levels for name, levels in found.items() if name not in tall})
    draw_plumes(page, "Air that a stream of sand draws in over 30 m", tall)
    page.note(PLUME_NOTE)


PLUME_NOTE = """**Plume.** B = g m'/rho_f, z from the source, means from the time on that a fall at 0.6 m/s takes (1.3 m/s over 30 m), levels from where
the plume has turned turbulent (the speed in its middle comes to fluctuate by a quarter). The field's plume with sixteen cells across its source does so
within three widths of it and draws in what Morton, Taylor and Turner's does; with eleven cells (37.5 mm) it stays smooth for longer and draws in less.
Sand of 100 um settles at some 0.6 m/s. 20 g/s of it fall through the first eddies, so that its plume stays smooth for longer, also where it is disturbed as
slowly as its own eddies turn; its exponent is that of plumes, its C is not. The grains stay in the fast middle of it, as their distance from its axis says
(a gas of that weight would be spread wider than its speed), and push the air for less long, so that less comes in. The same plume in ten times its size,
2 kg/s from 4 x 4 m over 30 m, as from a grab, falls several times faster than its sand settles: it draws in what a plume does. It is disturbed at the scenario's pace, in its own time; what another pace
does, the rows *disturbed more slowly* tell once they are run."""


def got_out(run):
    """What got out with the air through the sides, g/t."""
    return sum(way["g_per_tonne"] for way in run.summary["dust_outflow"].values())


def set_free(run):
    """What came off the grains, by any cause, g/t."""
    return sum(cause["g_per_tonne"] for c in run.summary["dust_on_grains"]["classes"].values() for cause in c["set_free_by"].values())


def emissions(runs, study, labels, more="", what=got_out):
    """Of each label what got out, g/t; None where it was not run."""
    found = [run_of(runs, study, label, more) for label in labels]
    return [what(run) if run.is_finished() else None for run in found]


def add_wind(page, runs):
    curves = []
    for more, (text, _, why) in SLUGS.items():
        out = emissions(runs, WIND, [wind(u) for u in SPEEDS], more)
        known = out[SPEEDS.index(KNOWN)]
        band = (lambda *limits: () if why else limits)
        if not more:
            page.add(f"wind: what gets out at {KNOWN} m/s, {text} [g/t]", known, f"{AP42_AT_KNOWN:.2g}: AP-42", why="calibrated: the emission coefficient")
        page.add(f"wind: exponent of what gets out of a slug that falls {text}", exponent(list(zip(SPEEDS, out))), "1.3 (AP-42, 13.2.4)",
                 *band(1.0, 1.6), why=why)
        for u, mine in zip(SPEEDS, out):
            if u != KNOWN:
                page.add(f"wind: {u} m/s over {KNOWN} m/s, {text}, over AP-42's", mine / known / (u / KNOWN) ** 1.3 if mine and known else None,
                         f"1: {(u / KNOWN) ** 1.3:.2f}", *band(0.667, 1.5), why=why)
        seen = list(zip(SPEEDS, out)) if all(out) else []
        curves.append(Curve(f"ours, {text}", [u for u, _ in seen], [mine / known for _, mine in seen], is_points=True))
    slow, known = emissions(runs, WIND, [wind(1), wind(KNOWN)], "far_off")
    page.add(f"wind: 1 m/s over {KNOWN} m/s, 1.5 m, the whole silt, over AP-42's, looked at 5 m downwind", slow / known * KNOWN**1.3 if slow and known else None,
             f"1: {KNOWN**-1.3:.2f}", why="an experiment: does dust that settles on the way make the difference?")
    page.chart("What wind takes off a slug", "wind [m/s]", f"dust that gets out, over that at {KNOWN} m/s",
               [*curves, published("AP-42: power 1.3", list(SPEEDS), [(u / KNOWN) ** 1.3 for u in SPEEDS], is_points=False)], "Law `shear`.")
    page.note(WIND_NOTE)


WIND_NOTE = """**Wind.** Law `shear`: what comes off goes with about the third power of the speed of wind and fall together, above a threshold, and by
what is left of the load. With the whole silt as the supply, which no wind exhausts, no fall passes: the form of the power is another one than AP-42's,
whose tests are of whole operations, with the impact. From 1.5 m the grain's own fall lifts the emission at 1 m/s (in still air AP-42 has none, a falling slug has some), from
0.75 m the wind's third power shows at 6 m/s. The coefficient scales all of it and cannot bend the curve, nor does it help to look farther downwind, where
more of the slow wind's dust has settled. A supply that is soon gone bends it: with two numbers fitted to AP-42, the coefficient to its level at 2 m/s and what
lies loose (50 g/t, in AP-42's shares of sizes), a fall of 0.6 m passes at all speeds; one of 1.5 m does not."""


def add_drop(page, runs):
    for name, (levels, unit, given) in DROPS.items():
        x, curves = list(levels.values()), []
        for text, what in (("gets out", got_out), ("is set free", set_free)):
            out = emissions(runs, DROP, levels, what=what)
            is_judged = what is got_out
            page.add(f"drop: exponent over the {name} of what {text}", exponent(list(zip(x, out))), f"{given:g} (VDI 3790-3)",
                     *((given - 0.3, given + 0.3) if is_judged else (None, None)), why=None if is_judged else "says where the exponent comes from")
            if all(out):
                curves.append(Curve(text, x, out, is_points=True))
        base = emissions(runs, DROP, ["base"])[0]
        if base:
            middle = levels["base"]
            curves.append(published("VDI 3790-3, through ours in the middle", x, [base * (v / middle) ** given for v in x], is_points=False))
        page.chart(f"Dust of a drop over the {name}", f"{name} [{unit}]", "dust [g/t]", curves, DROP_TEXT)
    flows = DROPS["mass flow"][0]
    for text, what in (("gets out", got_out), ("is set free", set_free)):
        page.add(f"drop: exponent over the mass flow of what {text}, law shear",
                 exponent(list(zip(flows.values(), emissions(runs, DROP, flows, "shear", what)))), "-0.5 (VDI 3790-3)",
                 why="an experiment: does a thick stream shelter its inside from the air?")
    page.note(DROP_NOTE)


DROP_TEXT = "What gets out leaves the box of 1.2 x 1.2 m through its sides; the rest settles on the plate, the floor, or is still in the air."
DROP_NOTE = """**Drop.** Law `energy` sets free with the energy that impacts dissipate, so with the first power of the height (a little less: drag,
and grains that leave the plate still moving) and not with the mass flow at all. What gets out rises faster with the height, and with the mass flow:
a longer fall and a thicker stream draw more air down, which carries dust along the plate and out of the box before it settles. The guideline's fall
with the mass flow is put down to the shelter that the inside of a thick stream has. It is there in the air: law `shear`, the same runs, sets free
less per tonne the thicker the stream is, and what gets out no longer rises. Dust that grains catch again on their way (`scavenging`) is
left out, and so is a stream that lands on its own heap."""


def fill(page, runs):
    for add in (add_plume, add_wind, add_drop, add_chute):
        add(page, runs)

"""What fails on the other pages, and the experiments to it: one thing changed at a time beside the run that fails."""

import dataclasses
import math
import statistics

import bed
import scatter
import study_points
from bed import SAND_DENSITY
from cases import belt, fluidised_studies, fluidised_vessel, hourglass, hourglass_friction, rectangular_container, resolved, settling_b
from runs import Plan

TITLE = "What fails, and the experiments to it"
BITS = ("container_walls", "container_periodic", "settling_a1", "dosta_drum", "fluidised_bed_column", "transfer_point", "mixer")
SOFT = {"materials.sand.young_modulus": "5 MPa"}
SAND = "interactions[0]"
HEAD, BELT_TOP = 0.08, 0.2  # [m] where the stream leaves the belt
EXPLAINS = "an experiment: it explains and judges nothing"


@dataclasses.dataclass(frozen=True)
class Experiment:
    """`varied`: (what is changed, plan) pairs, the run that fails first, or plans that differ by their seed alone in place of
    one; figure: of a run, with its unit."""

    failure: str
    question: str
    varied: tuple
    figure: callable
    unit: str


def figure(sensor, name, scale=1.0):
    def of(run):
        found = run.figure(sensor, name)
        return found and (scale * found[0], scale * (found[1] or 0.0))
    return of


def width_140(run):
    outer, inner = (run.figure("stream", f"drop_140_mm/quantile_{percent}") for percent in (95, 5))
    return outer and inner and (1e3 * (outer[0] - inner[0]), 1e3 * math.hypot(outer[1] or 0.0, inner[1] or 0.0))


def lowest_in_front(run):
    """Lowest mean pressure over density [m2/s2] of the places that lie before the stream, where it has not yet been; 0 where none of
    the sensor's does. The stream is the throw that its median 140 mm below the belt tells."""
    median = run.figure("stream", "drop_140_mm/median")
    places = [[run.figure("suction", f"place_{n}/{name}") for name in ("x", "z", "pressure_over_density")] for n in range(1, 6)]
    if not median or None in (each for place in places for each in place):
        return None
    in_front = [pressure for (x, _), (z, _), pressure in places
                if BELT_TOP > z and x - HEAD > median[0] * math.sqrt((BELT_TOP - z) / 0.14)]
    return min(in_front, default=(0.0, None))


def time_of_99_percent(run):
    time = hourglass.time_of_share(run, 0.99)
    return time and (time, None)


def first_maximum(run):
    """Of the drum's small grains in the quarter x < 0, z < 0; it turns from 0.5 s on."""
    found = [r["m1_below/number [1]"] for r in run.series() if 0.8 <= r["time [s]"] <= 1.7]
    return (max(found), None) if found else None


def drop_falling_at(litres):
    """[mbar], on the branch that falls: of the vessel from 1 s on."""
    return lambda run: bed.changing_drop(run, litres) if run.name in bed.CHANGING else bed.drop_at(run, litres, 1.0)


def bed_void_fraction(mass, section):
    """Of a bed of a mass [kg] on a section [m2] that has come to rest, by twice the height of its centre."""
    def of(run):
        height = run.figure("height", "twice_centre_at_end")
        return height and (1 - mass / SAND_DENSITY / section / height[0], None)
    return of


def void_fraction_of_beds(run):
    """The vessel's, or a part's of it."""
    return bed_void_fraction(*bed.mass_and_section(run.name))(run)


def small_bed(name, speed, settings):
    """6 x 3 mm of the column, 30 mm deep: floats from 0.4 s on and is let down until 1.4 s."""
    return Plan(f"fluidised_bed_small_{name}", "thesis/fluidised_bed_column.yaml", {
        "domain.max": "[6, 3, 160 mm]", "fluid.cells": "[1, 1, 32]", "emitters.sand.mass": "0.826 g", "emitters.sand.max": "[6, 3, 80 mm]",
        "sensors.drop.to": "[0, 0, 150 mm]", "sensors.u_mf.enabled": "false", "sensors.bubbles.enabled": "false", "references": "[]",
        "time.end": "1.45 s", "sensors.height.steady_after": "1.4 s", f"{bed.AIR}.speed": speed, f"{bed.AIR}.times": "[0.15, 0.4, 1.4 s]",
        f"{bed.AIR}.factors": "[0, 1, 0]", **bed.SOFT, **settings})


def small_beds(name, speed, settings):
    """Of three seeds: one bed of so few grains lies by chance as it lies."""
    return tuple(small_bed(f"{name}{end}", speed, {**settings, **seed})
                 for end, seed in (("", {}), ("_seed_2", {"seed": "2"}), ("_seed_3", {"seed": "3"})))


def poured_bed(name, settings):
    """The small bed, which is poured and never floats."""
    return small_bed(f"poured_{name}", "0.01 m/s", {
        f"{bed.AIR}.factors": "[0, 0, 0]", "time.end": "0.3 s", "sensors.height.steady_after": "0.25 s", **settings})


def thin_layer(layers):
    """5 mm of sand under 0.4 m/s, where 0.23 to 0.29 m/s fluidise it, in so many layers of cells on 60 mm."""
    return Plan(f"fluidised_bed_layer_{layers}", "thesis/fluidised_bed_column.yaml", {
        "domain.max": "[6, 6, 60 mm]", "fluid.cells": f"[2, 2, {layers}]", "emitters.sand.mass": "0.2754 g", "emitters.sand.max": "[6, 6, 58 mm]",
        "sensors.drop.to": "[0, 0, 59 mm]", "sensors.u_mf.enabled": "false", "sensors.bubbles.enabled": "false", "references": "[]",
        "time.end": "0.6 s", f"{bed.AIR}.speed": "0.4 m/s", f"{bed.AIR}.times": "[0.2, 0.25 s]", f"{bed.AIR}.factors": "[0, 1]", **bed.SOFT})


def swing(run):
    """Of the height [mm] while the flow stands, 0.3 s on."""
    heights = [1e3 * row["height/twice_centre [m]"] for row in run.series() if row["time [s]"] > 0.3]
    return (statistics.pstdev(heights), None) if heights else None


def slowly(plan):
    """A coarse bed whose flow falls half as fast: 5 l/min a second."""
    return Plan(f"{plan.name}_slow", plan.scenario, {**plan.settings, "time.end": "11 s", f"{bed.AIR}.times": "[0.2, 1, 11 s]"})


def of_case(case, *shown):
    """Runs that another page is made of: (text, name) pairs."""
    plans = {plan.name: plan for plan in case.plans()}
    return tuple((text, plans[name]) for text, name in shown)


def of_study(study, *shown, extra=None):
    """Points of a study: (text, label) pairs."""
    plans = dict(study_points.labelled(study, extra))
    return tuple((text, plans[label]) for text, label in shown)


def with_law(law):
    """A1 by a law, and in cells of ten diameters, in which the grain takes up 0.05 % and is as good as alone."""
    (base,) = of_study("settling_a1_drag", ("as it fails", law))
    return base, ("cells of ten diameters: one sphere by this law", Plan(f"{base[1].name}_alone", base[1].scenario,
                                                                        {**base[1].settings, "fluid.cells": "[2, 2, 5]"}))


def steeper(plan):
    return Plan(f"{plan.name}_rolling", plan.scenario, {**plan.settings, f"{SAND}.rolling.friction": "0.5"})


def variants(base, scenario, common, changes, as_is="as it fails"):
    return ((as_is, Plan(base, scenario, common)),
            *((text, Plan(f"{base}_{name}", scenario, {**common, **settings})) for text, name, settings in changes))


WIDE = {"bodies.tube.radius": "15 mm", "bodies.floor.radius": "16 mm", "emitters.bed.radius": "15 mm", "emitters.bed.mass": "42.4 g",
        "domain.min": "[-17, -17, -5 mm]", "domain.max": "[17, 17, 90 mm]"}


def hole(diameter):
    return {"bodies.floor.hole_radius": f"{diameter / 2:g} mm", "bodies.plug.radius": f"{diameter / 2:g} mm",
            "sensors.outlet.hole": f"{diameter} mm"}


# The vessel's bed: coarser grains or finer, walls or none.
VESSELS = of_case(fluidised_vessel, ("coarse grains that stand for 64, between walls, as it fails", "fluidised_bed_vessel_5"),
                  ("coarse grains that stand for 64, front and back periodic", "fluidised_bed_vessel_5_periodic"))


def bed_of(name):
    return next(plan for plan in fluidised_studies.plans() if plan.name == name)


# Narrow columns of the sand's own grains that come to rest.
SLUGGING, GENTLE = (Plan(name, f"thesis/{name.removesuffix('_5')}.yaml", bed.SOFT) for name in (bed.FALLING, bed.DEFLUIDISATION))
HURRIED = Plan(f"{bed.DEFLUIDISATION}_hurried", "thesis/fluidised_bed_defluidisation.yaml", {
    **bed.SOFT, "time.end": "2.85 s", f"{bed.AIR}.times": "[0.2, 0.5, 0.8, 2.4, 2.8 s]", f"{bed.AIR}.factors": "[0, 1, 1, 0.762, 0]",
    "sensors.u_mf.after": "0.8 s"})


FAST = Plan("fluidised_bed_wide_fast_5", "thesis/fluidised_bed_wide.yaml", {
    **bed.SOFT, "time.end": "3.4 s", f"{bed.AIR}.times": "[0.2, 0.5, 0.8, 5.3 s]", f"{bed.AIR}.factors": "[0, 1, 1, 0]"})


def coarse_bed(width):
    """The vessel's bed, periodic on all sides, of another width [mm]."""
    return Plan(f"fluidised_bed_coarse_{width}", fluidised_vessel.SCENARIO, {
        **bed.SOFT, "time.output_every": "0.5 s", **{f"domain.boundaries.{side}": fluidised_vessel.PERIODIC for side in ("front", "back", "left", "right")},
        "domain.max": f"[{width}, 15, 250 mm]", "emitters.sand.max": f"[{width}, 15, 240 mm]", "emitters.sand.mass": f"{2.295 * width:g} g",
        "fluid.cells": f"[{width // 5}, 3, 50]", "sensors.bubbles.max": f"[{width}, 15, 200 mm]"})


BEDS = (*VESSELS, ("coarse grains that stand for 27, between walls, 100 mm wide", bed_of("fluidised_bed_sides_walls")),
        ("coarse grains that stand for 27, periodic, 100 mm wide", bed_of(bed.WIDE)))
STIFF = {name: "50 MPa" for name in bed.SOFT}


def let_down_until(time):
    """Of a small bed: the flow is gone at this time [s]."""
    return {f"{bed.AIR}.times": f"[0.15, 0.4, {time:g} s]", "time.end": f"{time + 0.05:g} s", "sensors.height.steady_after": f"{time:g} s"}


# Densities of Table 6.6 at its mass flow, as many grains as in its base, and without air.
DENSITIES = (*of_study("table_6_6", ("1500 kg/m3", "rho_1500"), ("2650 kg/m3", "base"), ("3000 kg/m3", "rho_3000"), extra=belt.TO_ONE_SECOND),
             *((text, Plan(f"table_6_6_rho_{name}", "transfer_point.yaml", {"materials.sand.density": density, **settings, **belt.TO_ONE_SECOND}))
               for text, name, density, settings in (
                   ("1500 kg/m3, as many grains as at 2650", "1500_as_many", "1500", {"emitters.feed.mass_flow": "3.396 g/s"}),
                   ("3000 kg/m3, as many grains as at 2650", "3000_as_many", "3000", {"emitters.feed.mass_flow": "6.792 g/s"}),
                   ("1500 kg/m3, without air", "1500_dry", "1500", {"emitters.feed.velocity": "[0, 0, -0.2 m/s]", "fluid": "none"}))))


def diameters():
    """Runs of one diameter each: of 6 g/s, of as many fine grains as coarse ones, and without air."""
    air = {text: plan for text, plan in of_study("table_6_4_air", *((f"{air} {size}", f"{air} ['{size} um']") for air in ("with_air", "without_air")
                                                                  for size in (300, 600)), extra=belt.TO_ONE_SECOND)}
    fine = air["with_air 300"]
    return (("300 um", fine), ("600 um", air["with_air 600"]),
            ("300 um, as many grains as of 600 um", changed(fine, "as_many", {"emitters.feed.mass_flow": "0.75 g/s"})),
            ("300 um, without air", air["without_air 300"]), ("600 um, without air", air["without_air 600"]))


def at_speed(speed, feed):
    """A point of Table 6.4."""
    (point,) = of_study("table_6_4_speed", ("", f"{speed} m/s {feed} g/s"), extra=belt.TO_ONE_SECOND)
    return point[1]


def changed(plan, name, settings):
    return Plan(f"{plan.name}_{name}", plan.scenario, {**plan.settings, **settings})


# Little and much sand: on slow belts and on the fast one, without air, through the same opening, and what a grain that comes alone
# does on the belt until it leaves it.
FEW, MANY = at_speed(0.8, 1), at_speed(0.8, 6)
FEEDS = (*((f"{feed} g/s at {speed} m/s", at_speed(speed, feed)) for speed in (0.8, 0.2, 0.4) for feed in (1, 6)),
         *((f"{feed} g/s at 0.8 m/s, without air", changed(plan, "dry", {"fluid": "none"})) for feed, plan in ((1, FEW), (6, MANY))),
         ("1 g/s at 0.8 m/s through the opening of 6 g/s", changed(FEW, "wide", {
             key: value for key, value in MANY.settings.items() if key in ("emitters.feed.min", "emitters.feed.max")})),
         ("1 g/s at 0.8 m/s, without air, restitution at the belt 0.1 in place of 0.5", changed(FEW, "dry_e_pb_0.1", {
             "fluid": "none", "interactions[1].contact.restitution": "0.1"})),
         ("1 g/s at 0.8 m/s, without air, rolling friction at the belt 0.6 in place of 0.5", changed(FEW, "dry_rolling_0.6", {
             "fluid": "none", "interactions[1].rolling.friction": "0.6"})))

WINDS = of_study("table_6_6", ("still air", "base"), ("lid and air at +0.5 m/s", "lid_plus_0.5"),
                 ("wind of +0.5 m/s through the side", "wind_plus_0.5"), extra=belt.TO_ONE_SECOND)

# The hole of 5 mm in an hourglass of 20 mm, with the thesis's sand: a large one takes a day.
SMALL_HOURGLASS = {key: study_points.as_setting(value) for key, value in study_points.read(hourglass_friction.SMALL)["set"].items()}
HOURGLASSES = (
    ("friction 0.52, rolling 0.3, as calibrated", Plan("hourglass_small", "thesis/hourglass_5mm.yaml", SMALL_HOURGLASS)),
    ("the same, 50 MPa in place of 5", Plan("hourglass_small_stiff", "thesis/hourglass_5mm.yaml", {**SMALL_HOURGLASS, "materials.sand.young_modulus": "50 MPa"})),
    *of_study(hourglass_friction.SMALL, *((f"friction {mu_s}, rolling {mu_r}", f"{mu_s} {mu_r}") for mu_s in (0.4, 0.6) for mu_r in (0.2, 0.4))))


def poured_pile(name, travels=(6, 2), pace=1.0, settings=None):
    """A quarter of the funnel's sand. It rises by so many mm in two goes: by the thesis's slope the heap's tip is 8 mm high after
    the first, 10 at the end. `pace`: of all that flows, over that of 6 mm."""
    rise = ", ".join(f"{{model: translate, velocity: [0, 0, {pace * speed:g} mm/s], start: {0.2 + since / pace:g} s, travel: {travel} mm}}"
                     for speed, since, travel in ((30, 0.0, travels[0]), (8, 0.2, travels[1])))
    return Plan(f"pile_funnel_{name}", "thesis/pile_funnel.yaml", {
        **SOFT, "emitters.bed.mass": "2.5 g", "time.end": f"{0.8 + 0.8 / pace:g} s", "bodies.funnel.motions": f"[{rise}]",
        "bodies.hopper.motions": f"[{rise}]", "references": "[]", **(settings or {})})


EXPERIMENTS = (
    Experiment("A1 by the centre of the grain, too slow", "its own disturbance?",
               of_study("settling_a1_voidage", ("as it fails", "centre False"), ("own disturbance taken off", "centre True")),
               figure("fall", "velocity"), "m/s"),
    Experiment("A1 in a box of 5 diameters, too slow", "the box, or the grain in so few cells?",
               of_study("settling_a1_box", ("as it fails", "w_d_5"), ("10 diameters", "w_d_10"), ("20 diameters", "w_d_20"),
                        ("5 diameters in cells of a quarter of one", "w_d_5_big")), figure("fall", "velocity"), "m/s"),
    Experiment("A1 with Di Felice's law, too slow", "the law, or what we make of it?", with_law("di_felice"),
               figure("fall", "velocity"), "m/s"),
    Experiment("A1 with Koch and Hill's law, too slow", "the law, or what we make of it?", with_law("koch_hill"),
               figure("fall", "velocity"), "m/s"),
    Experiment("B1 with Gidaspow's law, too fast", "cells, interval, law, its own disturbance, or the walls that an unresolved sphere does not feel?",
               (*of_case(settling_b, ("as it fails", "settling_b1_gidaspow"), ("cells of half a diameter", "settling_b1_d_dx_2"),
                         ("cells of a sixth", "settling_b1_d_dx_6"), ("coupled ten times as often", "settling_b1_interval_10"),
                         ("Di Felice's law", "settling_b1_di_felice"), ("Abraham's law", "settling_b1_without"),
                         ("Abraham's law and lubrication", "settling_b1_with")),
                ("its own disturbance left in, as in the thesis", Plan("settling_b1_disturbed", "thesis/settling_b1.yaml", {
                    "drag.model": "gidaspow", "fluid_forces": "[]", "coupling.correct_own_disturbance": "false"})),
                *of_case(resolved, ("resolved by the grid, with its walls", "resolved_b1"))), figure("fall", "largest/velocity"), "m/s, largest"),
    Experiment("Beverloo's k, high in the 1.2 to 1.6 that are published", "does the tube of 20 mm hold the widest hole back?",
               variants("beverloo_10", "verification/beverloo.yaml", hole(10), (("tube of 30 mm", "wide", WIDE),), "tube of 20 mm"),
               figure("outlet", "rate_over_beverloo"), "of Beverloo's rate"),
    Experiment("The same at the narrowest hole", "is it the wide hole alone?",
               variants("beverloo_6", "verification/beverloo.yaml", hole(6), (("tube of 30 mm", "wide", WIDE),), "tube of 20 mm"),
               figure("outlet", "rate_over_beverloo"), "of Beverloo's rate"),
    Experiment("Periodic containers, flatter than the thesis's", "stiffness, rolling or time?",
               variants("container_periodic", "thesis/container_periodic.yaml", {"time.end": "0.9 s", **SOFT}, (
                   ("stiff as the thesis's", "50MPa", {"materials.sand.young_modulus": "50 MPa"}),
                   ("rolling friction 0.5 in place of 0.3", "rolling", {f"{SAND}.rolling.friction": "0.5"}),
                   ("until 1.5 s", "longer", {"time.end": "1.5 s"}))), figure("slope", "angle"), "deg"),
    Experiment("The container of 24 widths between walls, too flat", "rolling friction?",
               (("as it fails", rectangular_container.plan_of("walls", 24)),
                ("rolling friction 0.5 in place of 0.3", steeper(rectangular_container.plan_of("walls", 24)))), figure("slope", "angle"), "deg"),
    Experiment("The pile from a funnel, too flat", "how much sand it is, how far that falls on the tip, how fast it comes, or how it rolls and bounces?", (
        ("10 g, as it fails", Plan("pile_funnel", "thesis/pile_funnel.yaml", SOFT)),
        ("2.5 g, outlet 5 mm over a tip of 39 deg at the end", poured_pile("small")),
        ("2.5 g, outlet 2 mm over it", poured_pile("small_near", (3.5, 1.5))),
        ("2.5 g, outlet 10 mm over it", poured_pile("small_far", (11, 2))),
        ("2.5 g, outlet of 4 mm in place of 6", poured_pile("small_outlet_4", pace=0.31, settings={"bodies.funnel.radius": "2 mm"})),
        ("2.5 g, rolling friction 0.5 in place of 0.3", poured_pile("small_rolling", settings={f"{SAND}.rolling.friction": "0.5"})),
        ("2.5 g, restitution 0.5 in place of 0.9", poured_pile("small_restitution", settings={f"{SAND}.contact.restitution": "0.5"}))),
        figure("pile", "angle"), "deg"),
    Experiment("B2 to B4, too fast", "added mass and memory of the liquid, or its walls?",
               variants("settling_b3_with", "thesis/settling_b3.yaml", {}, (
                   ("with virtual mass", "virtual_mass", {"fluid_forces": "[{model: lubrication}, {model: virtual_mass}]"}),
                   ("with virtual mass and memory", "basset", {"fluid_forces": "[{model: lubrication}, {model: virtual_mass}, {model: basset}]"}),
                   ("box twice as wide", "wide", {"domain.max": "[200, 200, 160 mm]", "fluid.cells": "[54, 54, 43]",
                                                  "emitters.sphere.positions": "[[100, 100, 127.5 mm]]",
                                                  "sensors.fall.base": "[0, 0, 7.5 mm]"}))),
               figure("fall", "level_60_mm/velocity"), "m/s 60 mm over the floor"),
    Experiment("The hourglass, whose last grain comes late", "is it the sand's friction, or that it is soft? (in one of 20 mm)", HOURGLASSES,
               figure("outlet", "duration"), "s"),
    Experiment("The hourglass until 99 of 100 grains have left", "how much of the time is that of the last ones, which trickle one by one?",
               HOURGLASSES, time_of_99_percent, "s"),
    Experiment("The drum's counts", "how much is chance: other seeds of the packing",
               variants("dosta_drum", "thesis/dosta_drum.yaml", {"materials.m1.young_modulus": "10 MPa", "materials.m2.young_modulus": "5 MPa"},
                        tuple((f"seed {n}", f"seed_{n}", {"seed": str(n)}) for n in (2, 3))),
               first_maximum, "grains, first maximum"),
    Experiment("How densely sand lies that was poured, where the bulk density of 1530 kg/m3 is 0.423", "how far it falls, how it bounces, or the air that it falls through?",
               tuple((text, poured_bed(name, settings)) for text, name, settings in (
                   ("filled 80 mm high, 2.8 times as high as it rests", "80", {}),
                   ("52 mm, 1.8 times", "52", {"emitters.sand.max": "[6, 3, 52 mm]"}),
                   ("47 mm, 1.6 times, as the columns are now", "47", {"emitters.sand.max": "[6, 3, 47 mm]"}),
                   ("47 mm, without air", "47_dry", {"emitters.sand.max": "[6, 3, 47 mm]", "fluid": "none", "sensors.drop.enabled": "false"}),
                   ("80 mm, restitution 0.5 in place of 0.9", "80_half", {f"{SAND}.contact.restitution": "0.5"}),
                   ("80 mm, restitution 0.3", "80_inelastic", {f"{SAND}.contact.restitution": "0.3"}))),
               bed_void_fraction(0.826e-3, 6e-3 * 3e-3), "at rest"),
    Experiment("How densely a column lies that has floated", "how it collapses, the sand that does, or the cells that see it?",
               tuple((text, small_beds(name, *settings)) for text, name, *settings in (
                   ("floats at 0.35 m/s, down within 1 s", "gentle", "0.35 m/s", {}),
                   ("gentle, 50 MPa in place of 5", "stiff", "0.35 m/s", STIFF),
                   ("gentle, restitution 0.3 in place of 0.9", "inelastic", "0.35 m/s", {f"{SAND}.contact.restitution": "0.3"}),
                   ("floats at 0.35 m/s, down within 4 s", "slow", "0.35 m/s", let_down_until(4.4)))),
               bed_void_fraction(0.826e-3, 6e-3 * 3e-3), "at rest, of three seeds"),
    Experiment("The same in one small bed of each", "the pace, or the cells and steps that see it?",
               tuple((text, small_bed(name, *settings)) for text, name, *settings in (
                   ("floats at 0.35 m/s, down within 1 s", "gentle", "0.35 m/s", {}),
                   ("floats at 0.528 m/s, down within 1 s", "violent", "0.528 m/s", {}),
                   ("down within 4 s, 50 MPa in place of 5", "slow_stiff", "0.35 m/s", {**let_down_until(4.4), **STIFF}),
                   ("floats at 0.35 m/s, down within 12 s", "slower", "0.35 m/s", let_down_until(12.4)),
                   ("floats at 0.528 m/s, down within 1 s, cells of 2.5 mm in place of 5", "fine", "0.528 m/s", {"fluid.cells": "[2, 1, 64]"}),
                   ("gentle, coupled four times as often", "coupled", "0.35 m/s", {"time.fluid_step": "0.05 ms"}))),
               bed_void_fraction(0.826e-3, 6e-3 * 3e-3), "at rest"),
    Experiment("How densely a narrow column of 100 mm lies that has floated", "what it does before, or how fast the flow passes where it comes to rest?",
               (("floats at 95 l/min, where it slugs; 1.9 s from 70 to 48 l/min, 0.4 s to nothing", SLUGGING),
                ("floats at 63 l/min; 1.6 s to 48, 0.4 s to nothing", HURRIED),
                ("floats at 63 l/min; 2 s from 52 to 37, 0.4 s to nothing", GENTLE)),
               bed_void_fraction(9.18e-3, 20e-3 * 3e-3), "at rest"),
    Experiment("A narrow bed at 50 l/min, falling, where 13.4 mbar are measured", "how wide it is, or how fast its flow falls?",
               (*((f"{width} mm wide, by 10 l/min a second", coarse_bed(width)) for width in (20, 40, 60, 80, 100)),
                ("100 mm, by 5 l/min a second", slowly(coarse_bed(100))),
                ("200 mm, between side walls", VESSELS[1][1]), ("100 mm, finer grains", bed_of(bed.WIDE)), ("the same, by 21 l/min a second", FAST)),
               lambda run: bed.drop_at(run, 50, 1.0), "mbar"),
    Experiment("The poured bed at 20 l/min, rising, where 6.0 mbar are measured", "does it matter how far it fell?",
               (("filled 157 mm high", bed_of(bed.RAMP)),
                ("filled 240 mm high", Plan(f"{bed.RAMP}_high", "thesis/fluidised_bed_ramp.yaml", {**bed.SOFT, "emitters.sand.max": "[20, 3, 240 mm]", "time.end": "0.5 s"}))),
               lambda run: bed.drop_at(run, 20, 0.2, 0.5, bed.HALF_SPACING), "mbar"),
    Experiment("The floating bed, which carries its weight, where 15.4 to 15.6 mbar are measured at 65 to 75 l/min",
               "do walls that drag it down make the difference?",
               (("periodic", bed_of(bed.FLOATING)), *of_study("fluidised_bed_sides", ("front and back walls, 15 mm apart", "walls"), extra=bed.SOFT)),
               lambda run: bed.drop_at(run, 70, *bed.CHANGING[run.name if run.name in bed.CHANGING else bed.WIDE], bed.HALF_SPACING), "mbar at 70 l/min"),
    Experiment("The floating bed at 80 l/min, where 15.2 mbar are measured", "the same of a flow that is held?",
               (("periodic, while the flow falls slowly", bed_of(bed.FLOATING)), ("walls 15 mm apart, flow held", bed_of("fluidised_bed_rolling_0.3"))),
               lambda run: bed.changing_drop(run, 80) if run.name in bed.CHANGING else figure("drop", "pressure_drop", 0.01)(run), "mbar"),
    Experiment("Minimum fluidisation by the height, far above the 50 l/min that are measured", "the flow that the line of the floating bed begins with?",
               (("100 mm wide and deep, from 95 l/min", bed_of(bed.WIDE)), ("the vessel, from 80", VESSELS[1][1]),
                ("the vessel, 150 mm deep, from 70", bed_of("fluidised_bed_150mm_5"))),
               figure("u_mf", "falling/by_height", bed.VESSEL_SECTION * bed.LITRES_PER_MINUTE), "l/min"),
    Experiment("Minimum fluidisation by the pressure, below the 55 l/min that are measured in a bed of 150 mm",
               "the depth, or what coarse grains stand for?",
               (("100 mm wide and deep, for 27", bed_of(bed.WIDE)), ("the vessel, 100 mm deep, for 64", VESSELS[1][1]),
                ("the vessel, 150 mm deep, for 64, as it fails", bed_of("fluidised_bed_150mm_5")),
                ("200 mm deep", bed_of("fluidised_bed_200mm_5")), ("250 mm deep", bed_of("fluidised_bed_250mm_5"))),
               figure("u_mf", "falling/by_pressure", bed.VESSEL_SECTION * bed.LITRES_PER_MINUTE), "l/min"),
    Experiment("The vessel's bed at 30 l/min, falling, below the measured pressure", "walls, or coarse grains?", BEDS, drop_falling_at(30), "mbar"),
    Experiment("The same at 80 l/min, below", "walls, or coarse grains?", BEDS, drop_falling_at(80), "mbar"),
    Experiment("The void fraction of the vessel's bed at rest, where the thesis names 0.435 to 0.445", "walls, or coarse grains?",
               (*BEDS, ("a narrow column of the sand's own grains", SLUGGING)), void_fraction_of_beds, ""),
    Experiment("Light grains, which the thesis sees go less far", "the air, or how many there are at 6 g/s?", DENSITIES,
               figure("stream", "drop_140_mm/median", 1e3), "mm, median 140 mm below the belt"),
    Experiment("Light grains, which the thesis sees spread wider", "the air, or how many there are at 6 g/s?", DENSITIES, width_140,
               "mm, from 5 to 95 % of the stream 140 mm below the belt"),
    Experiment("Fine grains, which the thesis sees held back more", "the air, or how many there are at 6 g/s?", diameters(),
               figure("stream", "drop_140_mm/median", 1e3), "mm, median 140 mm below the belt"),
    Experiment("More sand, which the thesis sees widen the stream", "on the fast belt: the air, the opening of the feed, or how a grain that comes alone bounces and rolls on the belt?", FEEDS, width_140,
               "mm, from 5 to 95 % of the stream 140 mm below the belt"),
    Experiment("The eddies, which the thesis sees vanish with +0.5 m/s", "the lid, or the wind?", WINDS,
               figure("suction", "place_1/pressure_over_density"), "m2/s2, lowest anywhere"),
    Experiment("The eddies in front of the stream", "do these vanish, and those in the lee of belt and stream not?", WINDS, lowest_in_front,
               "m2/s2, lowest of those among the five places; 0: none"),
    Experiment("A layer of 5 mm that hangs in the air that would fluidise it", "do thinner cells see it move?",
               (("cells of 5 mm, as it fails", thin_layer(12)), ("of 2.5 mm", thin_layer(24)), ("of 1.25 mm", thin_layer(48))),
               swing, "mm, standard deviation of its height"))


def each_of(varied):
    return varied if isinstance(varied, tuple) else (varied,)


def plans():
    return [plan for experiment in EXPERIMENTS for _, varied in experiment.varied for plan in each_of(varied)]


def found(experiment, varied, runs):
    """The figure of a run, or the mean over those of several seeds, of which all have to be there."""
    figures = [experiment.figure(runs[plan.name]) for plan in each_of(varied)]
    if None in figures or len(figures) == 1:
        return None if None in figures else figures[0]
    return scatter.mean_of([value for value, _ in figures])


def fill(page, runs):
    for experiment in EXPERIMENTS:
        for text, varied in experiment.varied:
            page.add(f"{experiment.failure}: {text}", found(experiment, varied, runs), experiment.question, unit=experiment.unit, why=EXPLAINS,
                     keep=all(runs.is_done(runs[plan.name]) for plan in each_of(varied)))
    page.note("Each run beside the first of its group differs by what its row names and by nothing else.")
    page.note("The same sand in LIGGGHTS, from the same grains and by the same law and step, runs through a hole of 5 mm at the same rate "
              "([discharge](discharge.md)) and packs as densely ([packing](packing.md)): what is left of the hourglass's time is that of the last grains, "
              "or the thesis's own.")

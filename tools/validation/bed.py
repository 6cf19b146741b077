"""The beds of chapter 5: sand, air and vessel, Ergun's law, and the figures that any of its beds has."""

import json

from runs import read_table

SAND_DENSITY, AIR_DENSITY, AIR_VISCOSITY, GRAVITY = 2650.0, 1.2139, 1.8e-5, 9.81
SIZES = ((300e-6, 0.0621), (425e-6, 0.1829), (500e-6, 0.2605), (600e-6, 0.4945))  # mass fractions
VESSEL_SECTION = 0.2 * 0.015  # [m2]
LITRES_PER_MINUTE = 60000.0   # in a m3/s
AIR = "domain.boundaries.bottom.air"
SOFT = {"materials.sand.young_modulus": "5 MPa", "materials.plexiglass.young_modulus": "5 MPa"}
# Flow [l/min]: pressure drop [mbar] measured on 100 mm, and what verification.md lets pass.
MEASURED = {80: (15.0, 14.0, 16.5), 50: (13.40, None, None), 40: (10.93, None, None), 30: (8.20, 7.5, 9.5)}


def ergun(sizes, solids, velocity):
    """Pressure gradient [Pa/m] of a mixture at a superficial velocity, each size with its own drag."""
    eps = 1.0 - solids
    total = sum(share for _, share in sizes)
    return sum(share / total * (150 * AIR_VISCOSITY * solids ** 2 * velocity / (eps ** 3 * d ** 2)
                                + 1.75 * AIR_DENSITY * solids * velocity ** 2 / (eps ** 3 * d))
               for d, share in sizes)


def fluidisation(sizes, solids):
    """Superficial velocity [m/s] at which a packed bed costs its weight."""
    weight = solids * (SAND_DENSITY - AIR_DENSITY) * GRAVITY
    low, high = 0.0, 10.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ergun(sizes, solids, middle) < weight else (low, middle)
    return low


# The column, poured, while its flow rises; the wide bed while it comes to rest, and while it floats.
RAMP, WIDE, FLOATING = "fluidised_bed_ramp_5", "fluidised_bed_wide_5", "fluidised_bed_wide_floating_5"
# The flow [l/min] above which the wide bed floats and takes its time.
FLOATS_FROM = 62
# Narrow columns that fall (docs/validation/experiments.md).
FALLING, DEFLUIDISATION = "fluidised_bed_falling_5", "fluidised_bed_defluidisation_5"
# Mass [kg] and section [m2] of a part of the vessel, by its run; the whole one has the first.
WHOLE, PARTS = (0.459, VESSEL_SECTION), {
    WIDE: (0.153, 100e-3 * 10e-3), FALLING: (9.18e-3, 20e-3 * 3e-3), "fluidised_bed_sides_walls": (0.2295, 100e-3 * 15e-3)}
# While the flow rises or falls [s], in each one's scenario.
CHANGING = {RAMP: (0.2, 3.4), WIDE: (0.8, 5.4), FLOATING: (1.3, 4.8)}
# Half of what lies between two measured flows [l/min]: all of a pressure that swings that is nearest to one.
HALF_SPACING = 2.5


def mass_and_section(name):
    return PARTS.get(name, WHOLE)


def while_at(run, litres, name, value, since, until=1e9, within=1.0):
    """Mean of `value`, of a row of the series, while the flow is `within` so many l/min of `litres` between two times [s]."""
    def find():
        rows = [value(row) for row in run.series()
                if since < row["time [s]"] <= until and
                abs(row["drop/superficial_velocity [m/s]"] * VESSEL_SECTION * LITRES_PER_MINUTE - litres) < within]
        return (sum(rows) / len(rows), None) if rows else None
    return run.read_off("series", f"{name} within {within:g} of {litres:g} l/min, {since:g} to {until:g} s", find)


def drop_at(run, litres, since, until=1e9, within=1.0):
    """Mean pressure drop [mbar]."""
    return while_at(run, litres, "pressure_drop [mbar]", lambda row: row["drop/pressure_drop [Pa]"] / 100, since, until, within)


# Settings of a bed at rest: the one that the wide bed leaves, as the measured one, whose flow has fallen.
AT_REST = {**SOFT, f"{AIR}.times": "[0.05, 0.2, 2 s]", "time.end": "0.35 s", "sensors.drop.steady_after": "0.25 s",
           "sensors.height.steady_after": "0.25 s",
           "emitters.sand": json.dumps({"model": "file", "material": "sand", "with_velocities": False, "allowed_overlap": 0.2,
                                        "file": f"$RUNS/{WIDE}/results.h5"})}


def falling_at(litres):
    """The run that tells of a flow while it falls: of one at which the bed floats, what has bubbled long enough for a mean."""
    return FLOATING if litres > FLOATS_FROM else WIDE


def changing_drop(run, litres):
    """drop_at of one of the ramps, over half of what lies between two measured flows."""
    return drop_at(run, litres, *CHANGING[run.name], HALF_SPACING)


def add_column(page, run, name, has_friction=False):
    """The figures that a bed of any size has; one whose walls have friction may hang on them."""
    mass, section = mass_and_section(run.name)
    weight = mass * (1 - AIR_DENSITY / SAND_DENSITY) * GRAVITY / section
    plateau = run.figure("u_mf", "falling/plateau")
    page.add(f"{name}: pressure drop over weight", (plateau[0] / weight, None) if plateau else None,
             "1", **({"why": "walls with friction carry a part"} if has_friction else {"low": 0.98, "high": 1.02}))
    by_pressure = run.figure("u_mf", "falling/by_pressure")
    page.add(f"{name}: minimum fluidisation by pressure [m/s]", by_pressure,
             "0.311 (thesis, measured, 56 l/min), 0.286 (Ergun at 0.435)", low=0.250, high=0.333)
    page.add(f"{name}: the same in l/min of the whole vessel",
             by_pressure and (by_pressure[0] * VESSEL_SECTION * LITRES_PER_MINUTE, None), "56", low=45, high=60)
    # As it lies at 40 l/min, short of fluidisation: looser than when the flow is gone, for the sand is soft.
    height = while_at(run, 40, "twice_centre [m]", lambda row: row["height/twice_centre [m]"], 1.0)
    over_law, law = None, "1"
    if by_pressure and height:
        solids = mass / SAND_DENSITY / section / height[0]
        line = fluidisation(SIZES, solids)
        over_law, law = (by_pressure[0] / line, None), f"{line:.4f} m/s at {1 - solids:.4f}"
    page.add(f"{name}: minimum fluidisation over Ergun's law at the bed's own void fraction", over_law, law, low=0.95, high=1.05)
    page.add(f"{name}: minimum fluidisation by height [m/s]", run.figure("u_mf", "falling/by_height"),
             "0.278 (thesis, measured, 50 l/min)", why="a bed that bubbles has no one height; the thesis's two ways differ by 11 %")
    return weight


def add_drops(page, run, name):
    """Pressure drops of a bed of 100 mm on the ramp that falls from 1 s on."""
    for litres, (measured, low, high) in MEASURED.items():
        page.add(f"{name}: pressure drop at {litres} l/min [mbar]", drop_at(run, litres, 1.0),
                 f"{measured:.2f} (measured)",
                 **({"low": low, "high": high} if low else {"why": "judged by 30 and 80 l/min and the flow of fluidisation"}))


def draw(page, runs):
    """Pressure drop over the flow, ours beside both measured branches: of a ramp while its flow changes, else from 1 s on."""
    from chart import Curve, published
    table = read_table("thesis_bed_pressure_100mm.csv")
    curves = []
    for run in runs:
        since, until = CHANGING.get(run.name, (1.0, 1e9))
        rows = [r for r in run.series() if since < r["time [s]"] <= until]
        curves.append(Curve(run.name, [r["drop/superficial_velocity [m/s]"] * VESSEL_SECTION * LITRES_PER_MINUTE for r in rows],
                            [r["drop/pressure_drop [Pa]"] / 100 for r in rows]))
    for branch, name in (("decreasing", "measured, falling"), ("increasing", "measured, rising")):
        rows = [r for r in table if r["branch"] == branch]
        curves.append(published(name, [float(r["air_flow_l_min"]) for r in rows],
                                [float(r["corrected_pressure_mbar"]) for r in rows], [float(r["std_mbar"]) for r in rows]))
    page.chart("Pressure drop over the flow", "flow of the whole vessel [l/min]", "pressure drop [mbar]", curves,
               "Ours as it swings, beside the corrected pressure that the thesis measured on 100 mm, with its scatter.")

"""What the default time step does to figures of a heap, a box and a stream.

Each case runs with several seeds at the default step and at steps that make 10, 30, 60 and 200 of a collision at the
expected speed. The default's distance from the shortest step stands in standard errors of the difference: a step that
matters shows as more than two."""

import math
import pathlib
import statistics

from chart import Curve
from runs import Plan

TITLE = "The time step: what the default does to the figures"
BITS = ("transfer_point", "container_periodic", "dosta_drum", "small_hopper")
STEPS, SEEDS = (10, 30, 60, 200), (1, 2, 3, 4)
# Case: scenario, settings, figures as (sensor, figure, factor, unit).
CASES = {
    "transfer point without air": ("studies/small_transfer.yaml", {"fluid": "none", "time.end": "0.6 s"}, [
        ("stream", "drop_140_mm/median", 1e3, "mm"), ("stream", "drop_140_mm/quantile_95", 1e3, "mm"),
        ("stream", "drop_140_mm/quantile_5", 1e3, "mm")]),
    "heap and discharge (small hopper)": ("studies/small_hopper.yaml", {}, [
        ("slope", "angle", 1, "deg"), ("outlet", "rate", 1e3, "g/s")]),
    "box": ("verification/box.yaml", {}, [
        ("sides", "force_z", 1e3, "mN"), ("floor", "force_z", 1e3, "mN"),
        ("contacts", "mean_at_end", 1, "")]),
}


def name_of(scenario, step, seed):
    return f"{pathlib.Path(scenario).stem}_{step}_{seed}"


def plans():
    """At the default step; the others need to know how long a collision takes."""
    return [Plan(name_of(scenario, "default", seed), scenario, {**settings, "seed": str(seed)})
            for scenario, settings, _ in CASES.values() for seed in SEEDS]


def later(runs):
    found = []
    for scenario, settings, _ in CASES.values():
        contact = contact_time(runs[name_of(scenario, "default", SEEDS[0])])
        if contact:
            found += [Plan(name_of(scenario, step, seed), scenario,
                           {**settings, "seed": str(seed), "time.dem_step": f"{contact / step!r} s"})
                      for step in STEPS for seed in SEEDS]
    return found


def contact_time(run):
    return min(c["hertz_time_s"] for c in run.summary["size_classes"]) if run.is_finished() else None


def mean(runs, scenario, step, sensor, figure, factor):
    """(mean, standard error) over the seeds that have ended; None where none has."""
    found = []
    for seed in SEEDS:
        try:
            found.append(runs[name_of(scenario, step, seed)].figure(sensor, figure))
        except KeyError:
            return None
    values = [factor * f[0] for f in found if f]
    if not values:
        return None
    return statistics.mean(values), statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else 0.0


def fill(page, runs):
    for case, (scenario, _, figures) in CASES.items():
        for sensor, name, factor, unit in figures:
            by_step = {step: mean(runs, scenario, step, sensor, name, factor) for step in ("default", *STEPS)}
            text = f"{case}: {sensor} {name}" + (f" [{unit}]" if unit else "")
            for step in STEPS:
                page.add(f"{text}, collision / {step}", by_step[step], "-", why="a step of the comparison")
            page.add(f"{text}, default", by_step["default"], "-", why="judged by the next row")
            add_distance(page, text, by_step["default"], by_step[STEPS[-1]])
        draw(page, runs, case)
    page.note(f"Means and standard errors over {len(SEEDS)} seeds; grains are chaotic: two steps are two draws from one bed.")
    page.note('A single impact that sticks, by the same steps, is a test: `contact_verification -tc="*stick*"` (errors and order '
              "of convergence against the laws' own equations).")


def add_distance(page, text, default, finest):
    distance = None
    if default and finest:
        change, error = default[0] - finest[0], math.hypot(default[1], finest[1])
        distance = change / error if error else math.copysign(math.inf, change) if change else 0.0
    page.add(f"{text}: default less shortest step, in standard errors of the difference", distance, "0", -3, 3)


def draw(page, runs, case):
    scenario, _, figures = CASES[case]
    sensor, name, factor, unit = figures[0]
    found = [(step, mean(runs, scenario, step, sensor, name, factor)) for step in STEPS]
    found = [(step, f) for step, f in found if f]
    page.chart(f"{case}: {sensor} {name}", "steps of a collision", f"[{unit}]",
               [Curve("ours", [s for s, _ in found], [f[0] for _, f in found], [f[1] for _, f in found], is_points=True)],
               "Means and standard errors by step; nothing is published to stand beside it.")

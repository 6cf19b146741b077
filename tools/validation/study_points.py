"""Points of a study as runs, so that a page or a campaign can do them one by one."""

import itertools
import json
import math

import scatter
from commands import read_file
from runs import ROOT, Plan

FOLDER = ROOT / "scenarios" / "studies"


def read(study):
    return read_file(FOLDER / f"{study}.yaml")


def levels_of(given):
    """Levels of an axis: a list, whose last one may carry the unit of all, or {from, to, count}."""
    if isinstance(given, dict):
        step = (given["to"] - given["from"]) / (given["count"] - 1)
        return [round(given["from"] + n * step, 12) for n in range(given["count"])]
    if isinstance(given[-1], str) and len(given[-1].split(" ", 1)) == 2:
        unit = given[-1].split(" ", 1)[1]
        return [f"{v} {unit}" if isinstance(v, (int, float)) else v for v in given]
    return given


def as_setting(value):
    return value if isinstance(value, str) else json.dumps(value)


def points(text):
    """(name, settings) of each point of a study of cases, axes and axes that go together."""
    found = list((text.get("cases") or {"": {}}).items())
    axes = [[({path: level}, str(level)) for level in levels_of(given)] for path, given in (text.get("vary") or {}).items()]
    together = {path: levels_of(given) for path, given in (text.get("zip") or {}).items()}
    if together:
        rows = [dict(zip(together, values)) for values in zip(*together.values())]
        axes.append([(row, str(next(iter(row.values())))) for row in rows])
    out = []
    for (name, settings), *chosen in itertools.product(found, *axes):
        label = " ".join([name, *(text for _, text in chosen)]).strip()
        for more, _ in chosen:
            settings = {**settings, **more}
        out.append((label, {**(text.get("set") or {}), **settings}))
    out = [(label, {path: as_setting(v) for path, v in settings.items()}) for label, settings in out]
    seeds = range(1, text.get("replicates", 1) + 1)
    return out if len(seeds) == 1 else [(f"{label} seed {n}", {**settings, "seed": str(n)}) for label, settings in out for n in seeds]


def plan_of(study, label, settings, extra=None):
    base = (FOLDER / read(study)["base"]).resolve().relative_to(ROOT / "scenarios")
    name = "".join(c if c.isalnum() or c in "._-" else "_" for c in f"{study}_{label}")
    return Plan(name, str(base), {**settings, **(extra or {})})


def plans(study, extra=None):
    return [plan_of(study, label, settings, extra) for label, settings in points(read(study))]


def labelled(study, extra=None):
    """(name of the point, plan) for each point of a study."""
    return [(label, plan_of(study, label, settings, extra)) for label, settings in points(read(study))]


UNITS = {"mm": 1e-3, "g": 1e-3, "mbar": 100.0, "m/s": 1.0, None: 1.0, "deg": 1.0, "s": 1.0}


def measured(run, given):
    """(value, standard error) of a study's `measure` in a finished run; None if it is not there."""
    given = {"quantity": given} if isinstance(given, str) else given
    terms = [figure_at(run, given[key]) for key in ("quantity", "minus") if key in given]
    if None in terms:
        return None
    scale = UNITS[given.get("unit")]
    value = terms[0][0] - sum(t[0] for t in terms[1:])
    return value / scale, math.sqrt(sum((t[1] or 0.0) ** 2 for t in terms)) / scale


def figure_at(run, quantity):
    _, sensor, *path = quantity.split(".")
    return run.figure(sensor, "/".join(path))


def points_of(study, expectation):
    """The points that an expectation is about: where it holds an input `at` a level, those there."""
    held = expectation.get("at", {})
    return [(label, settings) for label, settings in points(read(study))
            if all(level == (label.split(" ")[0] if path == "case" else settings.get(path)) for path, level in held.items())]


def mean_of(found):
    """(mean, standard error) of (value, standard error) pairs; None where one is missing."""
    return None if None in found else (sum(v for v, _ in found) / len(found), math.sqrt(sum(e * e for _, e in found)) / len(found))


def mean_over_seeds(found):
    """The same, with the error that the scatter of three seeds or more tells: what a sensor tells of itself knows nothing of chance
    that is older than its averaging."""
    return None if None in found else scatter.mean_of([v for v, _ in found]) or mean_of(found)


def change(runs, study, expectation, extra=None):
    """(change, error) of an output from the first level of an input to its last, or between two named cases, as the mean over what else
    is varied and not held. None if a run is missing."""
    text = read(study)
    given, found = text["measure"][expectation["output"]], {}
    for label, settings in points_of(study, expectation):
        run = runs[plan_of(study, label, settings, extra).name]
        key = label.split(" ")[0] if expectation["input"] == "case" else settings.get(expectation["input"])
        point = label.rsplit(" seed ", 1)[0]
        found.setdefault(key, {}).setdefault(point, []).append(measured(run, given))
    levels = list(found)
    first, last = expectation.get("from", levels[0]), expectation.get("to", levels[-1])
    if first not in found or last not in found:
        return None
    before, after = (mean_of([mean_over_seeds(seeds) for seeds in found[level].values()]) for level in (first, last))
    if not before or not after:
        return None
    error = math.hypot(before[1], after[1]) or scatter_of_changes(found[first], found[last])
    return after[0] - before[0], error


def scatter_of_changes(before, after):
    """The standard error of a change by its scatter over what else is varied, where no sensor tells one; 0 of fewer than three."""
    means = [[mean_over_seeds(seeds)[0] for seeds in side.values()] for side in (before, after)]
    found = scatter.mean_of([a - b for b, a in zip(*means)])
    return found[1] if found else 0.0


def signed_change(runs, study, expectation, extra=None):
    """The same, positive where the sign is the expected one."""
    found = change(runs, study, expectation, extra)
    return found and (found[0] if expectation["then"] == "rises" else -found[0], found[1])


def sign_text(expectation):
    over = f"from {expectation['from']} to {expectation['to']}" if "from" in expectation else f"with {expectation['input']}"
    held = ", ".join(f"{path} {level}" for path, level in expectation.get("at", {}).items())
    return f"{expectation['output']} {expectation['then']} {over}" + (f" at {held}" if held else "")


def add_sign(page, runs, study, expectation, begin="", extra=None):
    """A row of a page: it passes where the change has the expected sign and is beyond twice its error."""
    what, published = f"{begin}{sign_text(expectation)}: change over twice its error", f"{expectation['then']}: {expectation['why']}"
    ours = signed_change(runs, study, expectation, extra)
    if ours and not ours[1]:
        page.add(what, math.copysign(math.inf, ours[0]), published, why="no error of the change is known")
    else:
        page.add(what, ours and ours[0] / (2 * ours[1]), published, low=1.0)

"""Points of a study as runs, so that a page or a campaign can do them one by one."""

import itertools
import json
import math
import re

import effects
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


def axes_of(text):
    """(what it varies, levels) of each axis of a study, the cases first and inputs that go together last; a level is (settings, name)."""
    axes = [(("case",), [(settings, name) for name, settings in (text.get("cases") or {"": {}}).items()])]
    for path, given in (text.get("vary") or {}).items():
        axes.append(((path,), [({path: level}, str(level)) for level in levels_of(given)]))
    together = {path: levels_of(given) for path, given in (text.get("zip") or {}).items()}
    if together:
        rows = [dict(zip(together, values)) for values in zip(*together.values())]
        axes.append((tuple(together), [(row, str(next(iter(row.values())))) for row in rows]))
    return axes


def points_with_levels(text):
    """(name, settings, places on all axes) of each point of a study of cases, axes and axes that go together."""
    out = []
    for chosen in itertools.product(*(enumerate(levels) for _, levels in axes_of(text))):
        label = " ".join(name for _, (_, name) in chosen).strip()
        settings = dict(text.get("set") or {})
        for _, (more, _) in chosen:
            settings |= more
        out.append((label, {path: as_setting(v) for path, v in settings.items()}, tuple(place for place, _ in chosen)))
    seeds = range(1, text.get("replicates", 1) + 1)
    return out if len(seeds) == 1 else [(f"{label} seed {n}", {**settings, "seed": str(n)}, levels) for label, settings, levels in out for n in seeds]


def points(text):
    """(name, settings) of each."""
    return [(label, settings) for label, settings, _ in points_with_levels(text)]


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


def terms_of(given):
    """The quantities that a study's `measure` is made of, and what it says of them."""
    given = {"quantity": given} if isinstance(given, str) else given
    return [given[key] for key in ("quantity", "minus") if key in given], given


def measured(run, given):
    """(value, standard error or None) of a study's `measure` in a finished run; None if it is not there."""
    quantities, given = terms_of(given)
    terms = [figure_at(run, quantity) for quantity in quantities]
    if None in terms:
        return None
    scale = UNITS[given.get("unit")]
    error = None if any(t[1] is None for t in terms) else math.hypot(*(t[1] for t in terms)) / scale
    return (terms[0][0] - sum(t[0] for t in terms[1:])) / scale, error


def figure_at(run, quantity):
    return run.figure(*place_of(quantity))


def place_of(quantity):
    """(sensor, figure) as summary.json names them."""
    _, sensor, *path = quantity.split(".")
    return sensor, "/".join(path)


def is_unsteady(run, given):
    """Whether a run says of what is measured that it has not settled."""
    return any(run.no_error(*place_of(quantity)) == effects.NOT_STEADY for quantity in terms_of(given)[0])


def points_of(study, expectation):
    """The points that an expectation is about: where it holds an input `at` a level, those there."""
    return [(label, settings) for label, settings, _ in held_points(read(study), expectation)]


def held_points(text, expectation):
    held = expectation.get("at", {})
    return [(label, settings, levels) for label, settings, levels in points_with_levels(text)
            if all(level == (label.split(" ")[0] if path == "case" else settings.get(path)) for path, level in held.items())]


def mean_over_seeds(found):
    """(mean, standard error or None) of (value, standard error) pairs by the scatter of three seeds or more: what a sensor tells of
    itself knows nothing of chance that is older than its averaging. Of fewer by what the sensors tell. None where one is missing."""
    if None in found:
        return None
    errors = [e for _, e in found]
    told = None if None in errors else math.hypot(*errors) / len(found)
    return scatter.mean_of([v for v, _ in found]) or (sum(v for v, _ in found) / len(found), told)


def ends_of(text, expectation):
    """(axis, place of its first level, of its last) of what an expectation is about: between the cases it names, from the smallest
    number to the largest, or of names as the study has them."""
    axis, (paths, levels) = next((n, axis) for n, axis in enumerate(axes_of(text)) if expectation["input"] in axis[0])
    given = [name if paths == ("case",) else as_setting(settings[expectation["input"]]) for settings, name in levels]
    if "from" in expectation:
        ends = [given.index(expectation[end]) if expectation[end] in given else None for end in ("from", "to")]
        return (axis, *ends)
    in_order = sorted(range(len(given)), key=lambda n: number_in(given[n])) if are_numbers(given) else range(len(given))
    return axis, in_order[0], in_order[-1]


def number_in(setting):
    return float(setting.split(" ")[0])


def are_numbers(settings):
    """Whether they are numbers, of one unit."""
    found = [re.fullmatch(r"([-+]?[\d.]+(?:e[-+]?\d+)?)( .*)?", setting) for setting in settings]
    return all(found) and len({f.group(2) for f in found}) == 1


def change(runs, study, expectation, extra=None):
    """The effects.Change of an output from the first level of an input to its last, or between two named cases, as the mean over what else
    is varied and not held. None if a run at either is missing; those that are missing between them tell no noise."""
    text = read(study)
    given, (axis, first, last) = text["measure"][expectation["output"]], ends_of(text, expectation)
    found = []
    for label, settings, levels in held_points(text, expectation):
        run = runs[plan_of(study, label, settings, extra).name]
        ours = measured(run, given)
        if ours:
            found.append(effects.Point(levels, settings.get("seed", ""), *ours, ours[1] is None and is_unsteady(run, given)))
        elif levels[axis] in (first, last):
            return None
    return effects.change_between(found, axis, first, last)


def signed_change(runs, study, expectation, extra=None):
    """The same, positive where the sign is the expected one."""
    found = change(runs, study, expectation, extra)
    return found and found.towards(expectation["then"])


def sign_text(expectation):
    over = f"from {expectation['from']} to {expectation['to']}" if "from" in expectation else f"with {expectation['input']}"
    held = ", ".join(f"{path} {level}" for path, level in expectation.get("at", {}).items())
    return f"{expectation['output']} {expectation['then']} {over}" + (f" at {held}" if held else "")


RULE = ("A sign counts when the change is told from noise: when it is larger than twice its standard error, or where few seeds tell that, "
        "than Student's t of so few. Where a figure is not steady its row is open. See [run a study](../how_to/run_a_study.md).")
VERDICTS = {effects.AS_EXPECTED: "pass", effects.AGAINST: "FAIL"}


def add_sign(page, runs, study, expectation, begin="", extra=None):
    """A row of a page: it passes where the change is told from noise and has the expected sign."""
    given = read(study)["measure"][expectation["output"]]
    what, published = f"{begin}{sign_text(expectation)}", f"{expectation['then']}: {expectation['why']}"
    unit = terms_of(given)[1].get("unit", "")
    ours = change(runs, study, expectation, extra)
    if ours is None:
        return page.add(what, None, published, band="sign, told from noise", verdict="open")
    if ours.error is None and not ours.unsteady:
        return page.add(what, (ours.size, None), published, unit=unit, why="no error of the change is known")
    kind = ours.kind(expectation["then"])
    verdict = f"{kind}: {ours.unsteady_text()}" if kind == effects.OPEN else VERDICTS.get(kind, kind)
    band = "sign, steady" if ours.unsteady else f"sign, beyond {effects.clear_limit(ours.freedom):.3g} errors"
    return page.add(what, (ours.size, ours.error), published, unit=unit, band=band, verdict=verdict)

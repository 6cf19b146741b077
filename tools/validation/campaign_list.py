"""The order in which a campaign runs, and what of it its budget reaches."""

import fnmatch
import sys

from runs import ROOT, one_of_each

ORDER = ROOT / "tools" / "validation" / "campaign.list"
BUDGET_HOURS = 80.0  # of one core: 40 hours of two


def numbered(file):
    """(number of the line, pattern) of each line of a list that names something."""
    named = ((number, line.split("#")[0].strip()) for number, line in enumerate(file.read_text().splitlines(), 1))
    return [(number, name) for number, name in named if name]


def read(file, plans):
    """Plans of a list of names, each run once; a name that nothing has is an error."""
    chosen = {}
    for number, name in numbered(file):
        found = fnmatch.filter(plans, name)
        if not found:
            sys.exit(f"{file}:{number}: error: no run is called '{name}'; tools/validation/run --list tells the names")
        chosen.update((each, plans[each]) for each in found)
    return one_of_each(chosen.values(), lambda plan: plan)


def patterns(file=ORDER):
    return [name for _, name in numbered(file)]


def place_of(name, order):
    """Of a run in the order; after all others if it is not there."""
    return next((n for n, pattern in enumerate(order) if fnmatch.fnmatch(name, pattern)), len(order))


def within_budget(hours, spent, order):
    """Names of those of `hours` (by name; None is unknown and counts nothing) that end before the budget does, `spent`
    hours of it being gone."""
    reached = []
    for name in sorted(hours, key=lambda name: place_of(name, order)):
        spent += hours[name] or 0.0
        if spent > BUDGET_HOURS:
            break
        reached.append(name)
    return reached

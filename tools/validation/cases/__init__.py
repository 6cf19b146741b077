"""The cases: one file each, found by its name. A case has

TITLE    of its page, docs/validation/FILE.md
BITS     cases of tools/dev/check_bits that go through the same parts of the engine: when the state of one of them
         has changed since a page's runs, the page is stale
plans()  the runs it needs, the ones that say most for their cost first
later(runs)  runs that begin with what one of those has left, where there are any
fill(page, runs)  figures, charts and notes, from runs that are finished or not

A page that is not one of runs (messages, a cluster) has write(args) in place of fill, and no plans; with
TAKES_FINISHED_RUNS it is written with --no-run as well."""

import importlib
import pathlib


def names():
    return sorted(f.stem for f in pathlib.Path(__file__).parent.glob("*.py") if f.stem != "__init__")


def load(name):
    return importlib.import_module(f"cases.{name}")


def all_plans():
    """Every run of every case by its name."""
    found = {}
    for case in names():
        for plan in load(case).plans():
            if found.setdefault(plan.name, plan) != plan:
                raise ValueError(f"two different runs are called {plan.name}; one is of {case}")
    return found

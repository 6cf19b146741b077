"""Rows of docs/validation/thesis.md that are worse than the thesis, each with its experiment on docs/validation/experiments.md."""

import re

from cases import experiments
from thesis.row import WORSE

# What a row's text begins with: the experiments to it, by what they are about.
EXPERIMENT_OF = {
    r"A1, centre": ("A1 by the centre",),
    r"A1, Di Felice": ("A1 with Di Felice's law",),
    r"A1, Koch and Hill": ("A1 with Koch and Hill's law",),
    r"A1, divided, W/D 5": ("A1 in a box of 5 diameters",),
    r"B\d[,:] (Gidaspow|D/dx|coupling interval|error of Di Felice)": ("B1 with Gidaspow's law",),
    r"B[234], Abraham": ("B2 to B4, too fast",),
    r".*g, (dry|air): discharging time": ("The hourglass",),
    r"pile, funnel": ("The pile from a funnel",),
    r"container, W/D \d+, walls": ("The container of 24 widths",),
    r"container, W/D \d+, periodic": ("Periodic containers",),
    r"100 mm, falling, 80 l/min": ("The same at 80 l/min", "The void fraction of the vessel's bed"),
    r".* mm: minimum fluidisation by height": ("Minimum fluidisation by the height",),
    r".* mm: minimum fluidisation by pressure": ("Minimum fluidisation by the pressure",),
    r"100 mm, falling, ramp, ([1-4]\d|\d|5[0-4])(\.\d+)? l/min": ("A narrow bed at 50 l/min",),
    r"100 mm, falling, ramp, ": ("The floating bed",),
    r"[1-4]\d l/min, walls": ("The vessel's bed at 30 l/min", "The void fraction of the vessel's bed"),
    r"100 mm, falling, ": ("The vessel's bed at 30 l/min", "The void fraction of the vessel's bed"),
    r"x_140 rises from rho": ("Light grains, which the thesis sees go",),
    r"x_140 rises from d_": ("Fine grains, which the thesis sees held back",),
    r"width_140 rises with emitters.feed.mass_flow": ("More sand, which the thesis sees widen",),
    r"width_140 falls from rho": ("Light grains, which the thesis sees spread",),
    r"eddy rises": ("The eddies, which", "The eddies in front"),
    r"penetration": ("A narrow bed at 50 l/min",),
    r"100 mm, rising, ([1-4]\d|\d)(\.\d+)? l/min": ("The poured bed at 20", "How densely sand lies"),
    r"100 mm, rising, ": ("The floating bed",)}


def experiments_of(what):
    """Experiments to a row of this text; none where nobody has made one yet."""
    begins = next((titles for pattern, titles in EXPERIMENT_OF.items() if re.match(pattern, what)), ())
    return [e for title in begins for e in experiments.EXPERIMENTS if e.failure.startswith(title)]


def section(rows, told):
    """`told`: what docs/validation/experiments.md says, a Kept."""
    worse = [row.cells("") for row in rows if row.verdict() == WORSE]
    groups = {}
    for cells in worse:
        groups.setdefault(tuple(e.failure for e in experiments_of(cells[1])), []).append(cells)
    out = ["## Worse than the thesis, and the experiment to each", "",
           "One thing changed at a time beside the run that fails: [experiments](experiments.md).", "",
           "| rows | ours | experiment | what it gave |", "| --- | --- | --- | --- |"]
    for failures, group in groups.items():
        found = [e for e in experiments.EXPERIMENTS if e.failure in failures]
        out.append("| " + " | ".join(("<br>".join(cells[1] for cells in group), "<br>".join(cells[4] for cells in group),
                                      "<br>".join(f"{e.failure}: {e.question}" for e in found) or "none yet",
                                      "<br>".join(result(e, told) for e in found) or "-")) + " |")
    return [*out, ""] if worse else []


def result(experiment, told):
    """The figure of each run of an experiment, as its page has it."""
    cells = [(text, told.row(f"{experiment.failure}: {text}")) for text, _ in experiment.varied]
    return "; ".join(f"{text} {row[1] if row else 'open'}" for text, row in cells)

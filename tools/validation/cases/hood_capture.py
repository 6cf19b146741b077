"""A hood where `engine suggest-hoods` puts it, in a plant that has it from the start: does it catch what was promised?"""

import json
import math
import re
import subprocess
import sys

import study_runs
from page import Page
from runs import Plan, Runs
from scatter import mean_of

TITLE = "A suggested hood catches what was promised"
BITS = ("coarse_transfer", "mixer", "dust_field")
TAKES_FINISHED_RUNS = True
SCENARIO = "plant/transfer_chute.yaml"
FIRST, DURATION = 6.0, 9.0              # s, of the first run and of each point of the study
COUNTED = FIRST + DURATION / 3          # s, from when on suggest-hoods counts
FLOW, OPENING = "9000 m3/h", "300 mm"
SEEDS = (11, 12, 13, 14)                # none of them is the study's
STUDY = "hood_capture_study"
COARSE = {"time.fluid_step": "5 ms", "time.output_every": "500 ms", "fluid.cells": "[34, 26, 30]",
          "emitters.fines.diameters": "[30 mm]", "emitters.fines.mass_fractions": "[1]",
          "emitters.lumps.diameters": "[60 mm]", "emitters.lumps.mass_fractions": "[1]",
          **{f"materials.{name}.young_modulus": "5 MPa" for name in ("limestone", "rubber", "steel")}}


def plans():
    return [Plan("hood_capture_first", SCENARIO, {**COARSE, "time.end": f"{FIRST} s"})]


def without_hood():
    """The plant as it is, looked at over the same time."""
    return Plan("hood_capture_without", SCENARIO, {**COARSE, "time.end": f"{FIRST + DURATION} s", "dust.steady_after": f"{COUNTED} s"})


def with_hood(study):
    """The plant with the hood of the study's last case, from the start, once for each seed."""
    import yaml  # who lists cases needs none

    case = list(yaml.safe_load(study.read_text())["cases"].values())[-1]
    hood = {path: value if isinstance(value, str) else json.dumps(value) for path, value in case.items()}
    more = {"time.end": f"{FIRST + DURATION} s", "dust.steady_after": f"{COUNTED} s", **hood}
    return [Plan(f"hood_capture_{seed}", SCENARIO, {**COARSE, **more, "seed": str(seed)}) for seed in SEEDS]


def told(args, *more):
    """What `engine suggest-hoods` says."""
    done = subprocess.run([args.engine.path(), "suggest-hoods", *map(str, more)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return done.stdout


def promised(table):
    """(percent, standard error or None) of the table's line of FLOW; None without one."""
    line = next((l for l in table.splitlines() if FLOW in l), "")
    found = re.search(r"([\d.]+)(?: ± ([\d.]+))? %$", line)
    return found and (float(found[1]), float(found[2]) if found[2] else None)


def caught(run):
    """Percent of the dust that goes out which hoods draw, in the steady stream; None of an unfinished run."""
    if not run.is_finished():
        return None
    drawn, left = (run.summary["dust_rates"][f"{way}/all/rate"]["value"] for way in ("drawn_out", "left"))
    return 100 * drawn / (drawn + left)


def write(args):
    first = Runs(plans(), args.runs, args.engine)
    file, folder = args.runs / f"{STUDY}.yaml", args.runs / STUDY
    if not args.no_run:
        for run in first:
            first.do(run)
        if not file.exists():
            told(args, args.runs / "hood_capture_first", "--places", 1, "--flows", FLOW, "--opening", OPENING, "--duration", f"{DURATION} s",
                 "--replicates", len(SEEDS), "-o", file)
        study_runs.run(args, file, "-o", folder, "--resume" if folder.exists() else "--force")
    confirming = with_hood(file) if file.exists() else []
    runs = Runs([*plans(), without_hood(), *confirming], args.runs, args.engine)
    if not args.no_run:
        for run in runs:
            runs.do(run)
    table = told(args, folder) if (folder / "study.csv").exists() else ""
    page = Page("hood_capture")
    shares = [caught(runs[plan.name]) for plan in confirming]
    ours, theirs = mean_of(shares), promised(table)
    error = math.hypot(ours[1], theirs[1]) if ours and theirs and theirs[1] else None
    page.add("caught with the hood from the start [%]", ours, f"{theirs[0]} ± {theirs[1]} promised" if theirs else "-", why="the next rows judge it")
    page.add("standard error of caught less promised [%]", error, "small, or the next row says nothing", high=3)
    page.add("caught less promised, in standard errors", (ours[0] - theirs[0]) / error if error else None, "0", -3, 3)
    without = caught(runs["hood_capture_without"])
    page.add("drawn out without that hood, by the one in the roof [%]", without, "-", why="the next row judges it")
    page.add("caught with the hood less without it, in standard errors of the former", (ours[0] - without) / ours[1] if ours and without is not None else None,
             "far from 0, or the hood does nothing", 10)
    if table:
        page.body(["## What was promised", "", "```", *table.splitlines(), "```", ""])
    page.note(f"The plant's transfer point in lumps of 30 and 60 mm and cells of 100 mm. A run of {FIRST:g} s finds the place; `engine suggest-hoods` "
              f"tries {FLOW} there from its last state, {len(SEEDS)} seeds, and counts from {COUNTED:g} to {FIRST + DURATION:g} s. Then the plant "
              f"starts with that hood, {sum(share is not None for share in shares)} other seeds, and is looked at over the same time; once more without it. The error of what is caught is "
              "that of the scatter of seeds; the promise's is no smaller than what each of its runs tells, for they share the state that they begin with.")
    page.write(TITLE, runs, "tools/validation/run hood_capture")

"""Runs a calibration whose truth is known: its targets are figures of runs at that truth. Needs Debian's python3-h5py."""

import json
import math
import sys

import scatter
import study_runs
from page import bits_line
from runs import ROOT, Plan, Runs

TITLE = "A calibration whose truth is known"
BITS = ("small_hopper",)
STUDY = ROOT / "scenarios/studies/calibrate_sand.yaml"
TRUTH = {"mu_s": 0.4, "mu_r": 0.15}
# Target: sensor, figure, unit in SI.
FIGURES = {"angle": ("slope", "mean_angle", 1.0), "mass": ("outlet", "mass", 1e-3)}
SEEDS = range(1, 7)
# Of the study itself, beside its own: a region of 95 % misses one time in twenty, so one answer says little. The verdict is the study's.
STUDY_SEEDS = range(2, 6)


def plans():
    """Runs at the truth: the study's targets are numbers in its file, and age with the engine."""
    return [Plan(f"calibration_truth_{seed}", "studies/small_hopper.yaml", {
        "interactions[0].contact.friction": f"{TRUTH['mu_s']}", "interactions[0].rolling.friction": f"{TRUTH['mu_r']}", "seed": f"{seed}"})
        for seed in SEEDS]


def at_truth(runs, target):
    """Mean of a target's figure over the runs at the truth with its standard error, in the target's unit; None where one is missing."""
    sensor, name, unit = FIGURES[target]
    found = [run.figure(sensor, name) for run in runs]
    return None if None in found else scatter.mean_of([value / unit for value, _ in found])


def in_region(folder, truth):
    """Whether the landscape of a calibration holds the truth in its region: the place of its grid
    that is nearest to it."""
    import h5py
    with h5py.File(folder / "study.h5") as file:
        group = file["calibration"]
        level = float(group.attrs["region_level"])
        places = group["places"]
        nearest, least = None, None
        ranges = {k: max(places[k][:]) - min(places[k][:]) for k in truth}
        for n in range(len(group["minus_log_density"])):
            off = max(abs(places[k][n] - v) / ranges[k] for k, v in truth.items())
            if least is None or off < least:
                nearest, least = n, off
        return float(group["minus_log_density"][nearest]) <= level


def with_seed(args, seed):
    """Folder of the study with another first seed, run unless args say otherwise."""
    folder = args.runs / f"{STUDY.stem}_seed_{seed}"
    if not args.no_run:
        file = args.runs / f"{folder.name}.yaml"
        text = STUDY.read_text().replace("\nbase: ", f"\nseed: {seed}\nbase: {STUDY.parent}/")
        file.write_text(text)
        study_runs.run(args, file, "-o", folder, "--resume" if folder.exists() else "--force")
    return folder


def write(args):
    file, truth = STUDY, TRUTH
    folder = args.runs / file.stem
    runs = Runs(plans(), args.runs, args.engine)
    if not args.no_run:
        for run in runs:
            runs.do(run)
        study_runs.run(args, file, "-o", folder, "--resume" if folder.exists() else "--force")
    seconds = sum(json.loads(summary.read_text())["cpu_s"] for summary in (folder / "points").glob("*/summary.json"))
    answer = json.loads((folder / "calibration.json").read_text())
    out = ["# A calibration whose truth is known", "", study_runs.written_by("calibration", args.engine), "",
           f"`engine study {study_runs.shown(file)}`: the targets are figures of runs at the truth, so the answer can be "
           "judged.", "",
           "| parameter | truth | best | mean ± deviation | region | truth between its ends | pinned down |",
           "| --- | --- | --- | --- | --- | --- | --- |"]
    holds = True
    for name, p in answer["parameters"].items():
        low, high = p["region"]
        inside = low <= truth[name] <= high
        holds = holds and inside
        out.append(f"| {name} | {truth[name]:g} | {p['best']:.3g} | {p['mean']:.3g} ± {p['deviation']:.2g} | "
                   f"{low:.3g} to {high:.3g} | {'yes' if inside else 'NO'} | {'yes' if p['is_pinned'] else 'no'} |")
    inside = in_region(folder, truth)
    others = [in_region(with_seed(args, seed), truth) for seed in STUDY_SEEDS]
    holds = holds and inside and answer["runs"] <= 30
    out += ["", "| | |", "| --- | --- |",
            f"| truth within the {100 * answer['confidence']:g} % region (all parameters together) | **{'yes' if inside else 'NO'}** |",
            f"| the same with the seeds {STUDY_SEEDS[0]} to {STUDY_SEEDS[-1]} | {others.count(True)} of {len(others)} |",
            f"| runs | **{answer['runs']}** (at most 30 wanted), {seconds:.0f} s of one core |",
            f"| targets met | {'yes' if answer['is_met'] else 'no'}, misfit {answer['misfit']:.2g} |", "",
            f"| target | wanted | {len(SEEDS)} runs at the truth | at the best place | scatter of single runs |", "| --- | --- | --- | --- | --- |"]
    for name, t in answer["targets"].items():
        truth_here = at_truth(runs, name)
        holds = holds and truth_here is not None and abs(t["value"] - truth_here[0]) <= 2 * math.hypot(t["error"], truth_here[1])
        told = f"{truth_here[0]:.4g} ± {truth_here[1]:.2g}" if truth_here else "not run"
        out.append(f"| {name} [{t['unit']}] | {t['value']:g} ± {t['error']:g} | {told} | {t['at_best']:.4g} ± "
                   f"{t['surrogate_error']:.2g} | {t['scatter']:.2g} |")
    out += ["", "What the study said:", ""] + [f"> {s}" for s in answer["statements"]]
    out += ["", "## Its runs", "", "| " + " | ".join(c for c in study_runs.table(folder)[0] if c not in ("replicate", "reason")) + " |"]
    rows = study_runs.table(folder)
    keep = [c for c in rows[0] if c not in ("replicate", "reason")]
    out += ["|" + " --- |" * len(keep)]
    out += ["| " + " | ".join(study_runs.rounded(r[c]) for c in keep) + " |" for r in rows]
    study_runs.write_page("calibration", [*out, "", bits_line(args.engine.bits())])
    if not holds:
        sys.exit("the calibration did not recover the truth within its region in 30 runs, or its targets are not those of runs at the truth")

"""Runs a calibration whose truth is known: its targets are figures of runs at that truth. Needs Debian's python3-h5py."""

import csv
import json
import sys

import study_runs
from page import bits_line
from runs import ROOT

TITLE = "A calibration whose truth is known"
BITS = ("small_hopper",)
STUDY = ROOT / "scenarios/studies/calibrate_sand.yaml"
TRUTH = {"mu_s": 0.4, "mu_r": 0.15}


def plans():
    return []


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


def write(args):
    file, truth = STUDY, TRUTH
    folder = args.runs / file.stem
    study_runs.run(args, file, "-o", folder, "--resume" if folder.exists() else "--force")
    with open(folder / "study.csv", newline="") as lines:
        seconds = sum(float(row["wall_s [s]"]) for row in csv.DictReader(lines))
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
    holds = holds and inside and answer["runs"] <= 30
    out += ["", "| | |", "| --- | --- |",
            f"| truth within the {100 * answer['confidence']:g} % region (all parameters together) | **{'yes' if inside else 'NO'}** |",
            f"| runs | **{answer['runs']}** (at most 30 wanted), {seconds:.0f} s one after the other |",
            f"| targets met | {'yes' if answer['is_met'] else 'no'}, misfit {answer['misfit']:.2g} |", "",
            "| target | wanted | at the best place | scatter of single runs |", "| --- | --- | --- | --- |"]
    for name, t in answer["targets"].items():
        out.append(f"| {name} [{t['unit']}] | {t['value']:g} ± {t['error']:g} | {t['at_best']:.4g} ± "
                   f"{t['surrogate_error']:.2g} | {t['scatter']:.2g} |")
    out += ["", "What the study said:", ""] + [f"> {s}" for s in answer["statements"]]
    out += ["", "## Its runs", "", "| " + " | ".join(c for c in study_runs.table(folder)[0] if c not in ("replicate", "reason")) + " |"]
    rows = study_runs.table(folder)
    keep = [c for c in rows[0] if c not in ("replicate", "reason")]
    out += ["|" + " --- |" * len(keep)]
    out += ["| " + " | ".join(study_runs.rounded(r[c]) for c in keep) + " |" for r in rows]
    study_runs.write_page("calibration", [*out, "", bits_line(args.engine.bits())])
    if not holds:
        sys.exit("the calibration did not recover the truth within its region in 30 runs")

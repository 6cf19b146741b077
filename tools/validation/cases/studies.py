"""Runs a study to its end, runs it once more into another folder, kills it with SIGKILL when half of its points have
finished, resumes it and compares both tables row for row."""

import signal
import subprocess
import sys
import time

import study_runs
from runs import ROOT

TITLE = "A study, killed half way and resumed"
# Two runs of one engine are compared: their figures stand for nothing else.
BITS = ()
STUDY = ROOT / "scenarios/studies/belt_speed.yaml"


def plans():
    return []


def kill_half_way(args, file, folder, points):
    """Starts the study and kills it, and only it, when half of its points have finished."""
    command = [args.engine.path(), "study", str(file), "-o", str(folder), "--force", "--quiet"]
    begin = time.time()
    process = subprocess.Popen(command)
    while len(study_runs.finished(folder)) < points // 2:
        if process.poll() is not None:
            sys.exit("the study ended before it could be killed")
        time.sleep(0.05)
    process.send_signal(signal.SIGKILL)
    process.wait()
    return process.returncode, time.time() - begin


def write(args):
    file = STUDY
    whole, cut = args.runs / "study_whole", args.runs / "study_cut"
    told, seconds = study_runs.run(args, file, "-o", whole, "--force")
    rows = study_runs.table(whole)
    status, until = kill_half_way(args, file, cut, len(rows))
    before = study_runs.finished(cut)
    files = {p: (cut / "points" / p / "summary.json").stat().st_mtime_ns for p in before}
    resumed, rest = study_runs.run(args, file, "-o", cut, "--resume")
    again = [p for p, at in files.items()
             if (cut / "points" / p / "summary.json").stat().st_mtime_ns != at]
    after = study_runs.table(cut)
    columns = list(rows[0])
    equal = sum(a == b for a, b in zip(rows, after)) if len(rows) == len(after) else 0
    states = sum(study_runs.state(whole, r["hash"]) == study_runs.state(cut, r["hash"]) for r in rows)
    from_checkpoint = sum("resumed at" in (cut / "points" / r["hash"] / "run.log").read_text()
                          for r in rows)
    name = study_runs.shown(file)
    out = ["# A study, killed half way and resumed", "", study_runs.written_by("studies", args.engine), "",
           f"`engine study {name}`, {len(rows)} points, run to its end; run again into another folder, the "
           "program killed with SIGKILL once half of the points had finished; resumed. `study.csv` of both, "
           "without wall times, and the states of all grains and cells at the end of every point compared.", "",
           "| | |", "| --- | --- |",
           f"| uninterrupted | {len(rows)} of {len(rows)} finished in {seconds:.0f} s |",
           f"| killed | after {until:.0f} s, {len(before)} of {len(rows)} finished, exit status {status} |",
           f"| resumed | {rest:.0f} s, {len(rows) - len(before)} points run, {from_checkpoint} of them from a "
           f"checkpoint, {len(again)} finished ones run again |",
           f"| rows of `study.csv` that are equal in all {len(columns)} columns but wall time | **{equal} of {len(rows)}** |",
           f"| points whose final state has the same SHA-256 | **{states} of {len(rows)}** |", "",
           "## The table", "",
           "| " + " | ".join(c for c in columns if c not in ("replicate", "seed", "reason")) + " |",
           "|" + " --- |" * sum(c not in ("replicate", "seed", "reason") for c in columns)]
    for row in rows:
        out.append("| " + " | ".join(study_runs.rounded(v) for c, v in row.items()
                                     if c not in ("replicate", "seed", "reason")) + " |")
    out += ["", "## Expected signs", ""] + [f"- {line}" for line in told if study_runs.verdict_of(line)]
    study_runs.write_page("studies", out)
    if equal != len(rows) or states != len(rows) or again:
        sys.exit("the resumed study is not the uninterrupted one")

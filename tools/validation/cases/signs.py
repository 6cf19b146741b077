"""Runs the studies of chapter 6 on a coarse base and lists their expected signs; points that have ended are taken as they
are. The same at full resolution: cases/belt.py."""

import re
import sys

import study_points
import study_runs
from page import bits_line
from runs import ROOT

TITLE = "Expected signs of the shipped studies"
BITS = ("coarse_transfer", "transfer_point", "mixer")
BASE = ROOT / "scenarios/studies/coarse_transfer.yaml"
STUDIES = [ROOT / f"scenarios/studies/{name}.yaml" for name in
           ("table_6_6", "table_6_4_plate", "table_6_4_inclination", "table_6_4_rolling")]


def plans():
    return []


def on_base(file, base, folder):
    """The study `file` on another base scenario."""
    text = file.read_text()
    changed, count = re.subn(r"(?m)^base:.*$", f"base: {base.resolve()}", text)
    if count != 1:
        sys.exit(f"{file}: one line 'base: FILE' expected")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / file.name).write_text(changed)
    return folder / file.name


def write(args):
    out = ["# Expected signs of the shipped studies", "", study_runs.written_by("signs", args.engine), ""]
    out += [f"Every study as shipped, but on the base `{study_runs.shown(BASE)}` (see its head for what is coarser "
            "there), so that signs can be looked at in minutes; digits do not hold.", ""]
    out += [study_points.RULE, "",
            "| study | expected | found | change | points | state |", "| --- | --- | --- | --- | --- | --- |"]
    tables = []
    against = 0
    for file in STUDIES:
        folder = args.runs / f"signs_{file.stem}"
        used = on_base(file, BASE, args.runs / "signs")
        told, _ = study_runs.run(args, used, "-o", folder, *(["--resume"] if folder.exists() else []), allowed=(0, 1))
        rows = study_runs.table(folder)
        done = sum(r["status"] == "finished" for r in rows)
        for line in told:
            match = study_runs.verdict_of(line)
            if not match:
                continue
            output, then, why, verdict, change = match.groups()
            against += verdict.startswith("against")
            out.append(f"| {file.stem} | {output} {then} {why} | {verdict} | {change or '-'} | "
                       f"{done} of {len(rows)} | {study_runs.states_of(folder, rows)} |")
        keep = [c for c in rows[0] if c not in ("replicate", "seed", "hash") and
                (c != "reason" or any(r["reason"] for r in rows))]
        tables += ["", f"## {file.stem}", "", "| " + " | ".join(keep) + " |", "|" + " --- |" * len(keep)]
        tables += ["| " + " | ".join(study_runs.rounded(r[c]) for c in keep) + " |" for r in rows]
    study_runs.write_page("signs", [*out, *tables, "", bits_line(args.engine.bits())])
    print(f"{against} against the expectation")

#!/usr/bin/env python3
"""result_files_test.py ENGINE SOURCE: every file, group, dataset, attribute, column and key that a run and a
study leave stands in docs/result_files.md, with its unit."""

import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ENGINE, SOURCE = sys.argv[1:3]
sys.path.insert(0, SOURCE + "/tests/support")
import needs_h5py  # noqa: E402, F401
import h5py  # noqa: E402

PAGE = pathlib.Path(SOURCE, "docs/result_files.md").read_text()
QUOTED = {word for words in re.findall(r"`([^`]+)`", PAGE) for word in re.split(r"[/,\s]+", words)}
UNITS = dict(re.findall(r"^\| `(\w+)` \| (\S+) \|", PAGE, re.M))
missing = set()


def named(word, where):
    if word not in QUOTED:
        missing.add(f"{where}: `{word}` does not stand in docs/result_files.md")


def walk(group, where):
    for attribute in group.attrs:
        named(attribute, where)
    for name, item in group.items():
        if not name.isdigit():
            named(name, f"{where}/{name}")
        if isinstance(item, h5py.Group):
            walk(item, f"{where}/{name}")
            continue
        unit = item.attrs["units"].decode()
        if name in UNITS and UNITS[name] != unit:
            missing.add(f"{where}/{name}: the unit is {unit}, not {UNITS[name]}")


def read_run(folder):
    for file in folder.iterdir():
        if file.is_file():
            named(file.name, "file")
    with h5py.File(folder / "results.h5") as file:
        walk(file, "results.h5")
    summary = json.loads((folder / "summary.json").read_text())
    for key in summary:
        named(key, "summary.json")
    for key in summary["health"]:
        if not re.fullmatch(r"largest_overlap_over_radius_(coarse|fine)", key):
            named(key, "health")
    for block in ("particles", "build", "emitters", "size_classes"):
        inner = summary[block]
        inner = inner[0] if isinstance(inner, list) else inner
        inner = next(iter(inner.values())) if block == "emitters" else inner
        for key in inner:
            if key != "diameter_m":
                named(key, f"summary.json {block}")
    for column in summary["series"]:
        if "/" not in column:
            named(column.split(" [")[0], "series.csv")


def read_study(folder):
    for file in folder.iterdir():
        named(file.name, "file")
    with h5py.File(folder / "study.h5") as file:
        for group in file:
            named(group, "study.h5")
        for name in file["points"]:
            named(name, "study.h5/points")
    with open(folder / "study.csv", newline="") as stream:
        columns = [name.split(" [")[0] for name in next(csv.reader(stream))]
    measured = {"emitters.feed.velocity", "emitters.feed.mass_flow", "passed", "rate", "emitted"}
    for name in columns:
        if name.removesuffix(" error") not in measured:
            named(name, "study.csv")


with tempfile.TemporaryDirectory(prefix="dust-files-") as folder:
    folder = pathlib.Path(folder)
    subprocess.run([ENGINE, "run", SOURCE + "/tests/scenario/small_transfer.yaml", "-o", folder / "run",
                    "--set", "time.end=2 ms", "--set", "time.output_every=1 ms", "--threads", "1", "--quiet"],
                   check=True, capture_output=True)
    subprocess.run([ENGINE, "study", SOURCE + "/tests/study/drop_study.yaml", "-o", folder / "study",
                    "--jobs", "1", "--quiet"], check=True, capture_output=True)
    read_run(folder / "run")
    read_study(folder / "study")
for problem in sorted(missing):
    print(problem)
sys.exit(1 if missing else 0)

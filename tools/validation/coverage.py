#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the error bars of a study's figures hold: each run against the mean of the others.

  tools/validation/coverage.py STUDY_FOLDER

For a study that is one point with replicates (scenarios/studies/dusty_replicas.yaml). Of every figure: the mean over
the runs, their standard deviation, the mean of the errors that the runs give, and in how many of the runs with an error
the mean of the others lies within 1.96 of it (the error of that mean added in squares). Honest errors cover 95 %; 20
runs say so to within 10 %. "without": runs that give none, because the figure has not settled or rests on few grains."""

import csv
import math
import pathlib
import sys


def columns_of(folder):
    """{name: [(value, error or None) of each finished run]}, in the order of the table."""
    with open(folder / "study.csv", newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["status"] == "finished"]
    if len(rows) < 3:
        raise SystemExit(f"{folder / 'study.csv'}: {len(rows)} finished runs; 3 at least are needed")
    names = list(rows[0])
    found = {}
    for name in names:
        plain = name.split(" [")[0]
        error = next((other for other in names if other.split(" [")[0] == plain + " error"), None)
        if error is not None:
            found[name] = [(float(row[name]), float(row[error]) if row[error] else None) for row in rows if row[name]]
    return found


def coverage_of(runs):
    """(mean, deviation, mean error, covered, with an error) of one figure."""
    count = len(runs)
    mean = sum(value for value, _ in runs) / count
    deviation = math.sqrt(sum((value - mean) ** 2 for value, _ in runs) / (count - 1))
    errors = [error for _, error in runs if error is not None]
    covered = 0
    for value, error in runs:
        if error is None:
            continue
        others = (count * mean - value) / (count - 1)
        covered += abs(value - others) <= 1.96 * math.hypot(error, deviation / math.sqrt(count - 1))
    return mean, deviation, sum(errors) / len(errors) if errors else None, covered, len(errors)


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    print("| figure | mean | deviation of the runs | error they give | covered | without |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name, runs in columns_of(pathlib.Path(sys.argv[1])).items():
        mean, deviation, error, covered, with_error = coverage_of(runs)
        share = f"{covered} of {with_error}" if with_error else "-"
        print(f"| {name} | {mean:.4g} | {deviation:.2g} | {'-' if error is None else f'{error:.2g}'} | {share} "
              f"| {len(runs) - with_error} |")


if __name__ == "__main__":
    main()

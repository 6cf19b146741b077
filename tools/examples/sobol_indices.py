#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sobol indices: how much of a figure's variance comes from which parameter. NumPy and dust_results only.

usage: sobol_indices.py SETTINGS.yaml FOLDER [ENGINE]

SETTINGS.yaml: {base: SCENARIO, count: 16, quantity: sensors.slope.angle, over: {PATH: [from, to], ...}}.
Runs count (k + 2) points for k parameters as a study in FOLDER (an interrupted one goes on), and prints of
each parameter the first-order index, its own effect, and the total one, with all it does together with
others. Estimators: Saltelli et al. 2010 (first order), Jansen 1999 (total),
doi:10.1016/j.cpc.2009.09.018.
"""

import pathlib
import subprocess
import sys

import numpy as np
import yaml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))
import dust_results  # noqa: E402


def sample(settings):
    """Points in rows: A, B, and for each parameter A with that column of B."""
    over = settings["over"]
    low, high = np.array(list(over.values()), float).T
    generator = np.random.default_rng(settings.get("seed", 1))
    a, b = low + (high - low) * generator.random((2, settings["count"], len(over)))
    mixed = []
    for column in range(len(over)):
        mixed.append(a.copy())
        mixed[-1][:, column] = b[:, column]
    return np.concatenate([a, b, *mixed])


def indices(outputs, count):
    """First-order and total index of each parameter."""
    a, b, *mixed = outputs.reshape(-1, count)
    variance = np.var(np.concatenate([a, b]))
    if variance == 0:
        sys.exit("error: the figure is the same in all points")
    return [(np.mean(b * (m - a)) / variance, np.mean((a - m) ** 2) / 2 / variance) for m in mixed]


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    file, folder = map(pathlib.Path, sys.argv[1:3])
    engine = sys.argv[3] if len(sys.argv) == 4 else "engine"
    settings = yaml.safe_load(file.read_text())
    points = sample(settings)
    study = {"name": "sobol_indices", "base": settings["base"],
             "zip": {path: points[:, n].tolist() for n, path in enumerate(settings["over"])},
             "measure": {"figure": settings["quantity"]}}
    written = file.with_suffix(".study.yaml")
    written.write_text(yaml.safe_dump(study))
    how = ["--resume"] if (folder / "study.csv").exists() else []
    subprocess.run([engine, "study", written, "-o", folder, "--quiet", *how], check=True)
    results = dust_results.Study(folder)
    if len(results.finished) < len(points):
        sys.exit(f"error: {results}; the indices need all of them")
    print(f"{len(points)} points; mean {results.table['figure'].mean():.4g} {results.table.unit('figure')}")
    print("parameter: own effect, total effect")
    for path, (own, total) in zip(settings["over"], indices(results.table["figure"], settings["count"])):
        print(f"{path}: {own:.2f}, {total:.2f}")


if __name__ == "__main__":
    main()

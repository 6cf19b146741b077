#!/usr/bin/env python3
"""Reads a study, or a run, with h5py and plots it (Debian: python3-h5py, python3-matplotlib).

usage: read_results.py FOLDER [PICTURE.png]

A study's folder holds study.h5: every output is drawn against every numeric input. A run's folder
holds results.h5: the grains of the last frame are drawn from the side, coloured by speed.
"""

import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def units(dataset):
    text = dataset.attrs["units"]
    text = text.decode() if isinstance(text, bytes) else text
    return "" if text in ("", "1") else f" [{text}]"


def draw_study(file):
    inputs = {k: v for k, v in file["inputs"].items() if v.dtype.kind == "f"}
    outputs = file["outputs"]
    finished = file["points/status"][:] == b"finished"
    figure, axes = plt.subplots(len(outputs), max(1, len(inputs)), squeeze=False,
                                figsize=(4 * max(1, len(inputs)), 3 * len(outputs)))
    for row, (name, values) in zip(axes, outputs.items()):
        for axis, (key, levels) in zip(row, inputs.items()):
            error = file["outputs_error"].get(name)
            axis.errorbar(levels[finished], values[finished], fmt="o",
                          yerr=None if error is None else np.nan_to_num(error[finished]))
            axis.set_xlabel(key + units(levels))
            axis.set_ylabel(name + units(values))
    print(f"{finished.sum()} of {finished.size} points finished")
    return figure


def draw_run(file):
    frames = sorted(k for k in file["particles"] if k.isdigit())
    frame = file["particles"][frames[-1]]
    place = frame["position"][:]
    speed = np.linalg.norm(frame["velocity"][:], axis=1)
    figure, axis = plt.subplots()
    dots = axis.scatter(1e3 * place[:, 0], 1e3 * place[:, 2], c=speed, s=2)
    figure.colorbar(dots, label="speed [m/s]")
    axis.set_aspect("equal")
    axis.set_xlabel("x [mm]")
    axis.set_ylabel("z [mm]")
    time = float(np.ravel(frame.attrs["time"])[0])
    axis.set_title(f"{len(place)} grains at t = {time:.3f} s")
    print(f"{len(frames)} frames, {len(place)} grains in the last")
    return figure


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    picture = sys.argv[2] if len(sys.argv) == 3 else str(folder / "picture.png")
    is_study = (folder / "study.h5").exists()
    with h5py.File(folder / ("study.h5" if is_study else "results.h5")) as file:
        figure = draw_study(file) if is_study else draw_run(file)
    figure.tight_layout()
    figure.savefig(picture, dpi=150)
    print(f"drawn in {picture}")


main()

# SPDX-License-Identifier: Apache-2.0
"""A study: a folder with study.h5 and the runs of its points."""

import csv
import json
import pathlib

import h5py
import numpy as np

from .run import Run
from .table import ResultsError, Table, split_unit


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


class Study:
    """The results of a study, as they were when it was opened."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        file = self.folder / "study.h5"
        if not file.exists():
            more = ("; it holds a run: use dust_results.Run"
                    if (self.folder / "series.csv").exists() else "")
            raise ResultsError(f"{self.folder} is not the folder of a study{more}")
        with h5py.File(file, "r") as data:
            groups = {name: {key.replace("|", "/"): (_column(one), _text(one.attrs["units"]))
                             for key, one in data[name].items()}
                      for name in ("inputs", "outputs", "outputs_error", "points")}
        order = self._order()
        for name in ("inputs", "outputs"):
            groups[name] = dict(sorted(groups[name].items(), key=lambda one: order.index(one[0])))
        self.inputs = list(groups["inputs"])
        self.outputs = list(groups["outputs"])
        self.table = _joined(groups, self.folder.name)

    def __repr__(self):
        return f"study {self.folder}: {len(self.finished)} of {len(self.table)} points finished"

    def _order(self):
        """The columns as the study file has them; study.h5 has them by the alphabet."""
        with open(self.folder / "study.csv", newline="", encoding="utf-8") as stream:
            return [split_unit(head)[0] for head in next(csv.reader(stream))]

    @property
    def finished(self):
        """The points that are finished, as a table."""
        return self.table[self.table["status"] == "finished"]

    def run(self, point):
        """The run of a point, counted from 1 as in the column `point`."""
        if not 1 <= point <= len(self.table):
            raise ResultsError(f"{self.folder} has the points 1 to {len(self.table)}, not {point}")
        return Run(self.folder / "points" / self.table["hash"][point - 1])

    @property
    def calibration(self):
        """calibration.json as a dict: the answer of a calibration."""
        file = self.folder / "calibration.json"
        if not file.exists():
            raise ResultsError(f"{self.folder} holds no calibration.json: it is not a calibration, or "
                               "not ended")
        return json.loads(file.read_text(encoding="utf-8"))


def _column(dataset):
    values = dataset[()]
    return np.array([_text(one) for one in values]) if values.dtype.kind in "SO" else values


def _joined(groups, title):
    """Number, inputs, replicate, outputs with their errors, and what is known of the run."""
    points = groups["points"]
    count = len(points["status"][0])
    columns = {"point": (np.arange(1, count + 1), "1"), **groups["inputs"],
               "replicate": points["replicate"]}
    for name, column in groups["outputs"].items():
        columns[name] = column
        if name in groups["outputs_error"]:
            columns[name + " error"] = groups["outputs_error"][name]
    for name in ("status", "seed", "hash", "wall_s", "reason", "no_error"):
        if name in points:  # no_error: studies of before have none
            columns[name] = points[name]
    return Table({name: values for name, (values, _) in columns.items()},
                 {name: unit for name, (_, unit) in columns.items()}, title)

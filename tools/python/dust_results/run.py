# SPDX-License-Identifier: Apache-2.0
"""One run: a folder with series.csv, results.h5 and summary.json."""

import csv
import json
import pathlib

import h5py
import numpy as np

from .fields import Field, Fields, Walls
from .table import ResultsError, Table, find_name, split_unit


GRAIN_COLUMNS = ("id", "material", "diameter", "mass", "weight", "position", "velocity",
                 "angular_velocity", "force")


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def _number(value):
    return np.nan if value is None else value


class Run:
    """The results of a run. Files are opened when something is asked of them and closed again, so a
    run that is still going on can be read; what it writes next is there at the next question."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not (self.folder / "series.csv").exists() and not (self.folder / "results.h5").exists():
            more = ("; it holds a study: use dust_results.Study"
                    if (self.folder / "study.h5").exists() else "")
            raise ResultsError(f"{self.folder} is not the folder of a run{more}")

    def __repr__(self):
        return f"run {self.folder}: {len(self.times)} frames"

    # --- what the run says of itself

    @property
    def is_ended(self):
        """Whether the run has written its summary: it is finished, interrupted or failed."""
        return (self.folder / "summary.json").exists()

    @property
    def summary(self):
        """summary.json as a dict."""
        if not self.is_ended:
            raise ResultsError(f"{self.folder} holds no summary.json yet: the run is going on, or was "
                               "killed (engine run ... --resume goes on from its checkpoint)")
        return json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))

    @property
    def figures(self):
        """What the sensors found, one row each: sensor, figure, value, error (one standard error, NaN
        where none is known), unit."""
        rows = [(sensor, name, _number(one["value"]), _number(one["uncertainty"]), one["unit"])
                for sensor, all_of_it in self.summary["sensors"].items()
                for name, one in all_of_it.items()]
        names = ("sensor", "figure", "value", "error", "unit")
        columns = zip(*rows) if rows else [[] for _ in names]
        return Table({name: np.array(column) for name, column in zip(names, columns)},
                     title="figures of the sensors")

    def value(self, path):
        """One number of the summary, named as studies name it: `mass_kg.left`, or
        `sensors.stream.drop_100_mm.median`."""
        if path.startswith("sensors."):
            _, sensor, figure = (path + ".").split(".", 2)
            figure = figure.removesuffix(".")
            sensors = self.summary["sensors"]
            figures = sensors[find_name(sensor, sensors, "sensor")]
            return _number(figures[find_name(figure.replace(".", "/"), figures, "figure")]["value"])
        found, parts = self.summary, path.split(".")
        while parts:
            if not isinstance(found, dict):
                raise ResultsError(f"{path!r}: there is nothing below {'.'.join(path.split('.')[:-len(parts)])!r}")
            # Figures are named by paths: "left/right/rate" of dust_rates.
            rest = "/".join(parts)
            name = rest if rest in found else parts[0]
            found = found[find_name(name, found, "figure")]
            parts = [] if name == rest else parts[1:]
        return _number(found["value"]) if isinstance(found, dict) and "value" in found else found

    @property
    def size_classes(self):
        """The sizes of the grains: diameter, time steps, and the masses emitted, in the domain, left
        and removed."""
        return _table_of(self.summary["size_classes"], "size classes")

    @property
    def timers(self):
        """Seconds spent in each phase, the longest first."""
        spent = sorted(self.summary["timers_s"].items(), key=lambda one: -one[1])
        return Table({"phase": np.array([name for name, _ in spent]),
                      "time": np.array([seconds for _, seconds in spent])},
                     {"time": "s"}, "where the time went")

    # --- over time

    @property
    def series(self):
        """series.csv: one row per sample. A row that is still being written is left out."""
        with open(self.folder / "series.csv", newline="", encoding="utf-8") as stream:
            whole = [line for line in stream if line.endswith("\n")]
        if not whole:
            return Table({}, title="series")
        rows = csv.reader(whole)
        heads = [split_unit(head) for head in next(rows)]
        values = np.array([[float(cell or "nan") for cell in row] for row in rows])
        values = values.reshape(-1, len(heads))
        return Table({name: values[:, n] for n, (name, _) in enumerate(heads)}, dict(heads), "series")

    @property
    def times(self):
        """The times of the frames [s]."""
        if not (self.folder / "results.h5").exists():
            return np.array([])
        with self._open() as file:
            frames = file["particles"]
            return np.array([frames[name].attrs["time"] for name in self._frames(file)], float)

    def frame_at(self, time):
        """The number of the frame nearest to `time` [s]."""
        times = self.times
        if not len(times):
            raise ResultsError(f"{self.folder} holds no frame yet")
        return int(np.argmin(np.abs(times - time)))

    # --- one frame; -1 is the last

    def grains(self, frame=-1):
        """The computed grains of a frame: id, material, diameter, mass (of one real grain), weight (real
        grains per computed one), position, velocity, angular_velocity, force."""
        with self._open() as file:
            group = file["particles"][self._frame(file, frame)]
            # Those known first, in the order of the docs; more may follow.
            names = sorted(group, key=lambda name: (GRAIN_COLUMNS + (name,)).index(name))
            columns = {name: group[name][()] for name in names}
            units = {name: _text(group[name].attrs["units"]) for name in names}
            materials = np.array([_text(name) for name in file.attrs["material_names"]])
            time = float(group.attrs["time"])
        columns["material"] = materials[columns["material"]]
        units["material"] = ""
        return Table(columns, units, f"grains at t = {time:.6g} s")

    def air(self, frame=-1):
        """The air of a frame, fields by name: velocity, pressure, void_fraction, momentum_exchange,
        open_fraction (share of the cell that is not inside a body)."""
        with self._open() as file:
            if "origin" not in file["fluid"].attrs:
                raise ResultsError(f"{self.folder} is a run without air")
            layout = file["fluid"].attrs["origin"], file["fluid"].attrs["spacing"]
            group = file["fluid"][self._frame(file, frame)]
            time = float(group.attrs["time"])
            sets = dict(group.items())
            sets.setdefault("open_fraction", file["fluid/open_fraction"])
            return Fields({name: Field(name, data[()], _text(data.attrs["units"]), *layout, time)
                           for name, data in sets.items()})

    def sensor_fields(self, frame=-1):
        """What sensors keep by place: {sensor: {name: Field}}; empty if no sensor does."""
        with self._open() as file:
            name = self._frame(file, frame)
            time = float(file["particles"][name].attrs["time"])
            group = file.get(f"sensors/{name}")
            if group is None:
                return {}
            return {sensor: Fields({key: Field(key, data[()], _text(data.attrs["units"]),
                                               data.attrs["origin"], data.attrs["spacing"], time)
                                    for key, data in sets.items()})
                    for sensor, sets in group.items()}

    def walls(self, frame=-1):
        """The surfaces of the bodies in a frame."""
        with self._open() as file:
            group = file["walls"][self._frame(file, frame)]
            names = np.array([_text(name) for name in file["walls"].attrs["names"]] or [""])
            return Walls(group["points"][()].reshape(-1, 3), group["triangles"][()].reshape(-1, 3),
                         names[group["body"][()]])

    def _open(self):
        try:
            return h5py.File(self.folder / "results.h5", "r")
        except OSError as problem:
            raise ResultsError(f"{self.folder / 'results.h5'} cannot be read: {problem}") from None

    @staticmethod
    def _frames(file):
        return sorted(name for name in file["particles"] if name.isdigit())

    def _frame(self, file, frame):
        frames = self._frames(file)
        if not -len(frames) <= frame < len(frames):
            raise ResultsError(f"{self.folder} holds {len(frames)} frames, numbered from 0; there is no "
                               f"frame {frame}")
        return frames[frame]


def _table_of(rows, title):
    """A list of equal dicts of numbers as a table; a dict within is told apart by a dot, a unit at the
    end of a name (`_s`, `_m`, `_kg`) becomes the column's."""
    flat = [{f"{key}.{part}" if part else key: number
             for key, one in row.items()
             for part, number in (one.items() if isinstance(one, dict) else [("", one)])}
            for row in rows]
    columns, units = {}, {}
    for key in flat[0] if flat else ():
        head, dot, part = key.partition(".")
        name, _, unit = head.rpartition("_")
        if unit not in ("s", "m", "kg"):
            name, unit = head, "1"
        columns[name + dot + part] = np.array([_number(row[key]) for row in flat])
        units[name + dot + part] = unit
    return Table(columns, units, title)

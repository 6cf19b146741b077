# SPDX-License-Identifier: Apache-2.0
"""A table: named columns of one length, each with its unit."""

import csv
import difflib

import numpy as np


class ResultsError(Exception):
    """Results that are not there or cannot be read; the message says where and what to do."""


def find_name(name, names, what):
    """`name` if it is among `names`; otherwise a ResultsError that lists the nearest ones."""
    names = list(names)
    if name in names:
        return name
    near = difflib.get_close_matches(str(name), names, 5, 0.5) or names[:10]
    there = ("there are " + ", ".join(map(repr, near))) if near else "there are none"
    raise ResultsError(f"there is no {what} {name!r}; {there}")


def split_unit(header):
    """'mass [kg]' as ('mass', 'kg'); a header without a unit has the unit ''."""
    if header.endswith("]") and " [" in header:
        name, _, unit = header[:-1].rpartition(" [")
        return name, unit
    return header, ""


def with_unit(name, unit):
    """'mass [kg]', and 'number' where the unit is none or 1."""
    return name if unit in ("", "1") else f"{name} [{unit}]"


class Table:
    """Columns by name: `table["mass"]` is a NumPy array, `table.unit("mass")` its unit.

    A number or a list of names, a mask, a slice or an array of indices gives a table again:
    `grains[grains["diameter"] < 1e-4]`.
    """

    def __init__(self, columns, units=None, title=""):
        self._columns = {name: np.asarray(column) for name, column in columns.items()}
        lengths = {len(column) for column in self._columns.values()}
        if len(lengths) > 1:
            raise ValueError(f"columns of different lengths: {sorted(lengths)}")
        self._length = lengths.pop() if lengths else 0
        self._units = dict(units or {})
        self.title = title

    @property
    def names(self):
        return list(self._columns)

    def unit(self, name):
        """The unit of a column: 'kg/s'; '1' for a number without dimension, '' for texts."""
        return self._units.get(find_name(name, self._columns, "column"), "")

    def __len__(self):
        return self._length

    def __contains__(self, name):
        return name in self._columns

    def __iter__(self):
        return iter(self._columns)

    def __getitem__(self, key):
        if isinstance(key, str):
            return self._columns[find_name(key, self._columns, "column")]
        if isinstance(key, list) and key and all(isinstance(one, str) for one in key):
            return Table({name: self[name] for name in key},
                         {name: self.unit(name) for name in key}, self.title)
        if isinstance(key, (int, np.integer)):
            key = slice(key, key + 1 if key != -1 else None)
        return Table({name: column[key] for name, column in self._columns.items()},
                     self._units, self.title)

    def rows(self):
        """Every row as a dict of name and value."""
        for n in range(len(self)):
            yield {name: column[n] for name, column in self._columns.items()}

    def scalars(self):
        """The same table with vectors in three columns: position_x, position_y, position_z."""
        columns, units = {}, {}
        for name, column in self._columns.items():
            parts = [(name, column)]
            if column.ndim == 2:
                parts = [(f"{name}_{axis}", column[:, d]) for d, axis in enumerate("xyz")]
            for part, values in parts:
                columns[part] = values
                units[part] = self.unit(name)
        return Table(columns, units, self.title)

    def write_csv(self, file):
        """Writes the table with 'name [unit]' in the first line."""
        flat = self.scalars()
        with open(file, "w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow([with_unit(name, flat.unit(name)) for name in flat])
            writer.writerows(zip(*(flat[name].tolist() for name in flat)))

    def to_pandas(self):
        """The table as a pandas.DataFrame; needs pandas."""
        import pandas

        flat = self.scalars()
        return pandas.DataFrame({with_unit(name, flat.unit(name)): flat[name] for name in flat})

    def __repr__(self):
        flat = self.scalars()
        shown = [n for n in range(len(flat)) if n < 5 or n >= len(flat) - 5]
        lines = [[with_unit(name, flat.unit(name)) for name in flat]]
        for n in shown:
            if n > 5 and n - 1 not in shown:
                lines.append(["..."] * len(flat.names))
            lines.append([_cell(flat[name][n]) for name in flat])
        widths = [max(map(len, column)) for column in zip(*lines)]
        text = "\n".join("  ".join(cell.rjust(width) for cell, width in zip(line, widths))
                         for line in lines)
        return f"{self.title + ': ' if self.title else ''}{len(self)} rows\n{text}"


def _cell(value):
    return f"{value:.6g}" if isinstance(value, (float, np.floating)) else str(value)

# SPDX-License-Identifier: Apache-2.0
"""Fields on the cells of a regular grid: the air, and what sensors keep by place."""

import numpy as np

from .table import find_name

AXES = "xyz"


class Field:
    """Values at cell centres. `values[k, j, i]` belongs to the i-th cell along x, the j-th along y
    and the k-th along z; of a vector the last index is the component."""

    def __init__(self, name, values, unit, origin, spacing, time):
        self.name, self.values, self.unit, self.time = name, values, unit, time
        self.origin, self.spacing = np.asarray(origin, float), np.asarray(spacing, float)

    def centres(self, axis):
        """Coordinates of the cell centres along 'x', 'y' or 'z' [m]."""
        d = AXES.index(find_name(axis, AXES, "axis"))
        count = self.values.shape[2 - d]
        return self.origin[d] + (np.arange(count) + 0.5) * self.spacing[d]

    def magnitude(self):
        """The field of the lengths of its vectors; of a field of numbers the field itself."""
        if self.values.ndim == 3:
            return self
        return Field(f"magnitude of {self.name}", np.linalg.norm(self.values, axis=3), self.unit,
                     self.origin, self.spacing, self.time)

    def plane(self, axis, at=None):
        """The values in the layer of cells square to `axis` that holds the coordinate `at` [m]
        (default: the middle layer); the first index is the later of the two other axes."""
        d = AXES.index(find_name(axis, AXES, "axis"))
        count = self.values.shape[2 - d]
        layer = count // 2 if at is None else int((at - self.origin[d]) // self.spacing[d])
        return np.take(self.values, min(max(layer, 0), count - 1), axis=2 - d)

    def __repr__(self):
        count = self.values.shape[2::-1]
        return f"{self.name} [{self.unit}] on {count[0]} x {count[1]} x {count[2]} cells"


class Fields(dict):
    """Fields by name; a name that is not there is told with those that are."""

    def __missing__(self, name):
        find_name(name, self, "field")


class Walls:
    """Surfaces of the bodies: `points` (n, 3) [m], `triangles` (m, 3) indices into them, `body` the
    name of each triangle's body."""

    def __init__(self, points, triangles, body):
        self.points, self.triangles, self.body = points, triangles, body

    def section(self, axis, at):
        """Where the surfaces cut the plane `axis` = `at`: segments (n, 2, 3) [m]."""
        d = AXES.index(find_name(axis, AXES, "axis"))
        corners = self.points[self.triangles].astype(float)
        height = corners[:, :, d] - at
        # A corner in the plane would give a triangle one point or three: take it as just above.
        height = np.where(height == 0.0, 1e-12, height)
        ends = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            ha, hb = height[:, a, None], height[:, b, None]
            with np.errstate(divide="ignore", invalid="ignore"):
                point = corners[:, a] + (corners[:, b] - corners[:, a]) * (ha / (ha - hb))
            ends.append(np.where(ha * hb < 0.0, point, np.nan))
        ends = np.stack(ends, axis=1)
        is_cut = np.isfinite(ends[:, :, 0])
        ends = ends[is_cut.sum(axis=1) == 2]
        return ends[np.isfinite(ends[:, :, 0])].reshape(-1, 2, 3)

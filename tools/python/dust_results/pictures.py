# SPDX-License-Identifier: Apache-2.0
"""Pictures with Matplotlib. Each function gives a Figure: `figure.savefig("name.png")`.

The figures know no window and no global state, so they are drawn without a display as well.
"""

import numpy as np

from .fields import AXES
from .table import ResultsError, find_name, with_unit

#: Beyond this many grains each is a dot instead of a circle of its size.
MOST_CIRCLES = 200_000
DOTS_PER_INCH = 150
#: What is finer than this share of the picture is drawn as large as this, to be seen.
SMALLEST_SHARE = 1 / 300


def _figure(width=6.4, height=4.8, **grid):
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise ResultsError("pictures need Matplotlib (Debian: python3-matplotlib)") from None
    figure = Figure((width, height), dpi=DOTS_PER_INCH, constrained_layout=True)
    return figure, figure.subplots(**grid)


def _scale(lengths):
    """The unit that suits lengths of this size: factor and name."""
    return (1e3, "mm") if np.max(np.abs(lengths)) < 3 else (1, "m")


def _across(axis):
    """The two axes of a picture that looks along `axis`."""
    find_name(axis, AXES, "axis")
    return [d for d in range(3) if AXES[d] != axis]


def draw_grains(run, frame=-1, colour="speed", along="y", finer_than=None):
    """The grains of a frame, seen along an axis, at their true size (fine ones larger, to be seen), with the
    bodies cut in the middle.

    `colour` is 'speed' or a column of numbers of run.grains(); `finer_than` [m] leaves out what is
    coarser.
    """
    from matplotlib.collections import EllipseCollection

    grains = run.grains(frame)
    title = grains.title.split(" at ")[-1]
    if finer_than is not None:
        grains = grains[grains["diameter"] < finer_than]
    values = np.linalg.norm(grains["velocity"], axis=1) if colour == "speed" else grains[colour]
    label = with_unit(colour, "m/s" if colour == "speed" else grains.unit(colour))
    a, b = _across(along)
    figure, axes = _figure()
    place = grains["position"][:, [a, b]].astype(float)
    walls = run.walls(frame)
    factor, unit = _scale(place if len(place) else np.ones(1))
    if 0 < len(place) <= MOST_CIRCLES:
        seen = np.concatenate([place, walls.points[:, [a, b]]])
        size = factor * np.maximum(grains["diameter"], SMALLEST_SHARE * np.ptp(seen, axis=0).max())
        dots = EllipseCollection(size, size, np.zeros(len(size)), units="xy", offsets=factor * place,
                                 transOffset=axes.transData, array=values, linewidths=0)
        axes.add_collection(dots)
    else:
        dots = axes.scatter(*(factor * place.T), c=values, s=0.2, linewidths=0)
    _draw_walls(axes, walls, along, factor)
    axes.autoscale_view()
    figure.colorbar(dots, ax=axes, label=label)
    axes.set(aspect="equal", xlabel=f"{AXES[a]} [{unit}]", ylabel=f"{AXES[b]} [{unit}]",
             title=f"{len(grains)} grains, {title}")
    return figure


def draw_air(run, frame=-1, quantity="velocity", along="y", at=None):
    """A layer of the air square to an axis: a field of run.air() in colours (of a vector its length),
    and arrows where it is the velocity. `at` [m]: where the layer is (default: the middle)."""
    air = run.air(frame)
    field = air[quantity]
    a, b = _across(along)
    values = np.ma.masked_where(air["open_fraction"].plane(along, at) < 0.5,
                                field.magnitude().plane(along, at))
    x, y = field.centres(AXES[a]), field.centres(AXES[b])
    factor, unit = _scale(np.concatenate([x, y]))
    figure, axes = _figure()
    colours = axes.pcolormesh(factor * x, factor * y, values, shading="nearest")
    figure.colorbar(colours, ax=axes, label=with_unit(field.magnitude().name, field.unit))
    if quantity == "velocity":
        arrows = field.plane(along, at)
        nth = [max(1, len(one) // 30) for one in (y, x)]
        axes.quiver(factor * x[::nth[1]], factor * y[::nth[0]], arrows[::nth[0], ::nth[1], a],
                    arrows[::nth[0], ::nth[1], b], color="white", width=0.002)
    axes.set(aspect="equal", xlabel=f"{AXES[a]} [{unit}]", ylabel=f"{AXES[b]} [{unit}]",
             title=f"{field.name}, t = {field.time:.6g} s")
    return figure


def draw_series(run, *names):
    """Columns of series.csv over time, one below the other."""
    series = run.series
    names = names or ("kinetic_energy", "particles")
    figure, rows = _figure(height=1 + 2 * len(names), nrows=len(names), sharex=True, squeeze=False)
    for axes, name in zip(rows[:, 0], names):
        axes.plot(series["time"], series[name])
        axes.set_ylabel(with_unit(name, series.unit(name)))
    rows[-1, 0].set_xlabel("time [s]")
    return figure


def draw_study(study, *outputs):
    """Outputs of the finished points against every input that is a number, with standard errors."""
    table = study.finished
    inputs = [name for name in study.inputs if table[name].dtype.kind == "f"]
    outputs = outputs or study.outputs
    if not inputs:
        raise ResultsError(f"{study.folder} varies nothing that is a number: draw study.table yourself")
    figure, grid = _figure(4 * len(inputs), 3 * len(outputs), nrows=len(outputs), ncols=len(inputs),
                           squeeze=False, sharex="col", sharey="row")
    for name, row in zip(outputs, grid):
        error = table[name + " error"] if name + " error" in table else None
        for key, axes in zip(inputs, row):
            axes.errorbar(table[key], table[name], fmt="o",
                          yerr=None if error is None else np.nan_to_num(error))
        row[0].set_ylabel(with_unit(name, table.unit(name)))
    for key, axes in zip(inputs, grid[-1]):
        axes.set_xlabel(with_unit(key, table.unit(key)))
    return figure


def _draw_walls(axes, walls, along, factor):
    from matplotlib.collections import LineCollection

    if not len(walls.points):
        return
    d = AXES.index(along)
    middle = 0.5 * (walls.points[:, d].min() + walls.points[:, d].max())
    lines = factor * walls.section(along, middle)[:, :, _across(along)]
    axes.add_collection(LineCollection(lines, colors="black", linewidths=0.8))

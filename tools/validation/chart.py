"""Charts of the pages: ours beside what is published, as SVG, by Debian's python3-matplotlib."""

import dataclasses
import sys

OURS, THEIRS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"), ("#000000", "#777777", "#aaaaaa")


@dataclasses.dataclass
class Curve:
    """A line, or points where `is_points`; the published ones are black and grey."""

    name: str
    x: list
    y: list
    errors: list = None
    is_ours: bool = True
    is_points: bool = False


def published(name, x, y, errors=None, is_points=True):
    return Curve(name, list(x), list(y), errors, is_ours=False, is_points=is_points)


def pyplot_for(file):
    try:
        import matplotlib
    except ImportError:
        sys.exit("charts need matplotlib: apt-get install python3-matplotlib")
    matplotlib.use("svg")
    # The same numbers give the same file: no date, no random names; letters stay letters.
    matplotlib.rcParams.update({"svg.hashsalt": file.name, "svg.fonttype": "none", "font.size": 10})
    from matplotlib import pyplot
    return pyplot


def save(figure, file, pyplot):
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, metadata={"Date": None})
    pyplot.close(figure)


def draw_bars(file, title, along, labels, series):
    """Bars side by side for each label: `series` holds {name: values}; a missing value is None."""
    pyplot = pyplot_for(file)
    figure, axes = pyplot.subplots(figsize=(7.2, 1.2 + 0.25 * len(labels) * (len(series) + 0.6)), layout="constrained")
    height = 0.8 / len(series)
    for n, ((name, values), colour) in enumerate(zip(series.items(), OURS)):
        places = [label + (n + 0.5) * height - 0.4 for label in range(len(labels))]
        axes.barh(places, [value or 0.0 for value in values], height, color=colour, label=name)
    axes.set_yticks(range(len(labels)), labels)
    axes.invert_yaxis()
    axes.set(title=title, xlabel=along)
    axes.grid(alpha=0.3, axis="x")
    if len(series) > 1:
        axes.legend(fontsize=9)
    save(figure, file, pyplot)


def draw(file, title, across, up, curves):
    pyplot = pyplot_for(file)
    figure, axes = pyplot.subplots(figsize=(7.2, 4.2), layout="constrained")
    colours = {True: iter(OURS * 4), False: iter(THEIRS * 4)}
    for curve in curves:
        style = {"color": next(colours[curve.is_ours]), "label": curve.name}
        if curve.errors or curve.is_points:
            axes.errorbar(curve.x, curve.y, yerr=curve.errors, fmt="o" if curve.is_ours else "s", capsize=3,
                          markersize=5, **style)
        else:
            axes.plot(curve.x, curve.y, "-" if curve.is_ours else "--", linewidth=1.4, **style)
    axes.set(title=title, xlabel=across, ylabel=up)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=9)
    save(figure, file, pyplot)

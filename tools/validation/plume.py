"""The flow of a plume over its height, from the frames of a run."""

import sys

import numpy

from runs import ROOT

sys.path.append(str(ROOT / "tools/python"))

import dust_results  # noqa: E402

SHARE = 0.05  # of the largest speed of a level: what is slower downwards is not the plume


def mean_fall(folder, begin):
    """(depths below the source [m], downward speed [k, j, i] in the mean since `begin` [m/s], area of a cell [m2])."""
    run = dust_results.Run(folder)
    frames = [n for n, time in enumerate(run.times) if time >= begin]
    field = run.air(frames[0])["velocity"]
    total = numpy.zeros(field.values.shape[:3])
    for n in frames:
        total -= run.air(n)["velocity"].values[..., 2]
    z = field.centres("z")
    top = z[-1] + field.spacing[2] / 2
    return top - z, total / len(frames), field.spacing[0] * field.spacing[1]


def flow(folder, begin):
    """(depths [m], flow [m3/s], radius of equal flow and momentum [m]) of the levels, from the source down."""
    depth, speed, area = mean_fall(folder, begin)
    plume = numpy.where(speed > SHARE * speed.max(axis=(1, 2), keepdims=True), speed, 0.0)
    volume, momentum = area * plume.sum(axis=(1, 2)), area * (plume**2).sum(axis=(1, 2))
    return depth[::-1], volume[::-1], (volume / numpy.sqrt(numpy.pi * momentum))[::-1]


def grain_spread(folder, begin, top, below):
    """Root mean square distance of grains from the domain's middle over that of the mean downward flow, both over the depths from `top` to `below` [m]."""
    run = dust_results.Run(folder)
    depth, speed, _ = mean_fall(folder, begin)
    field = run.air(0)["velocity"]
    x, y = numpy.meshgrid(field.centres("x"), field.centres("y"))
    layers = numpy.maximum(speed[(depth >= top) & (depth <= below)], 0.0)
    of_flow = (layers * (x**2 + y**2)).sum() / layers.sum()
    surface = field.centres("z")[-1] + field.spacing[2] / 2
    squares = []
    for n, time in enumerate(run.times):
        if time < begin:
            continue
        place = numpy.asarray(run.grains(n)["position"])
        is_seen = (surface - place[:, 2] >= top) & (surface - place[:, 2] <= below)
        squares.append((place[is_seen, :2] ** 2).sum(axis=1))
    return float(numpy.sqrt(numpy.concatenate(squares).mean() / of_flow))

#!/usr/bin/env python3
"""What a wall makes of the flow that a grain gives itself, on the grid that the engine has.

  tools/validation/wall_mobility.py [CELLS [HEIGHT]]    (56 and 44 cells: half a minute)

Solves the steady discrete Stokes flow of the staggered grid (edge 1, viscosity 1) between two walls, periodic along
them: the force is spread by the smooth kernel over the faces inside, the velocity gathered with its mirrored values
beyond the wall (core/coupling/stencils/smooth_kernel.hpp). Prints G over G_0 without a wall, and beside it eqs. (4) and (5) of
docs/theory/own_disturbance.md with what its h leaves of the drag. Needs NumPy."""

import sys

import numpy

SHARES = numpy.array([0.1583, 0.4946, 0.3471])  # eq. (3)
WAVES = numpy.array([0.0543, 0.3427, 1.1277])
LEAST_KNOTS = 1.25


def spline(x):
    far, near = 2.0 - abs(x), 1.0 - abs(x)
    return (far**3 if far > 0 else 0.0) - (4.0 * near**3 if near > 0 else 0.0)


def points(place, knots, is_of_faces, least=None):
    """Indices and weights along one axis; `least`: the halo's first."""
    shift = 0.0 if is_of_faces else 0.5
    first = int(numpy.ceil(place - shift - 2.0 * knots))
    if least is not None:
        first = max(first, least)
    index = numpy.arange(first, int(numpy.floor(place - shift + 2.0 * knots)) + 1)
    weight = numpy.array([spline((i + shift - place) / knots) for i in index])
    return index, weight / weight.sum()


def width(knots):
    return knots * (0.5835 - 0.0403 / knots**2)  # eq. (1)


class Channel:
    """Answers of wave after wave, across the channel."""

    def __init__(self, height):
        self.height = height
        self.middles = numpy.zeros((height, height))  # second derivative of what sits at middles, walls at half a cell
        for i in range(height):
            if 0 < i < height - 1:
                self.middles[i, i - 1:i + 2] = 1.0, -2.0, 1.0
            else:
                self.middles[i, i] = -2.0 / (0.5 * 1.5) - 2.0 / 1.5
                self.middles[i, 1 if i == 0 else height - 2] = 2.0 / 1.5
        inner = height - 1
        self.faces = -2.0 * numpy.eye(inner) + numpy.eye(inner, k=1) + numpy.eye(inner, k=-1)
        self.gradient = numpy.eye(inner, height, k=1) - numpy.eye(inner, height)

    def shear(self, k2, force):
        return numpy.linalg.solve(k2 * numpy.eye(self.height) - self.middles, force)

    def flow(self, k2, along, across):
        """Velocity along the wave and across the channel for a force along or across."""
        n, m, k = self.height, self.height - 1, numpy.sqrt(k2)
        matrix = numpy.zeros((2 * n + m, 2 * n + m))
        matrix[:n, :n] = k2 * numpy.eye(n) - self.middles
        matrix[:n, n + m:] = k * numpy.eye(n)
        matrix[n:n + m, n:n + m] = k2 * numpy.eye(m) - self.faces
        matrix[n:n + m, n + m:] = self.gradient
        matrix[n + m:, :n] = -k * numpy.eye(n)
        matrix[n + m:, n:n + m] = -self.gradient.T
        right = numpy.zeros(2 * n + m)
        right[:n] = 0.0 if along is None else along
        right[n:n + m] = 0.0 if across is None else across
        found = numpy.linalg.solve(matrix, right)
        return found[:n], found[n:n + m]


def mirrored(values, index, is_across):
    """Odd about the wall; faces inside are numbered from 1."""
    out = []
    for i in index:
        if is_across:
            out.append(0.0 if i == 0 else numpy.sign(i) * values[abs(i) - 1])
        else:
            out.append(values[i] if i >= 0 else -values[-1 - i])
    return numpy.array(out)


def mobility(is_across, diameter, distance, cells, channel):
    """G over G_0 and G_0, with the kernel's sigma."""
    knots = max(diameter, LEAST_KNOTS)
    normal = min(knots, 0.5 * (distance + 2.5))
    x, of_x = points(0.21, knots, not is_across)
    y, of_y = points(0.37, knots, False)
    z, of_z = points(distance, normal, is_across, -2)
    is_inside = z >= (1 if is_across else 0)
    force = numpy.zeros(channel.height - (1 if is_across else 0))
    force[z[is_inside] - (1 if is_across else 0)] = of_z[is_inside] / of_z[is_inside].sum()
    wave = 2.0 * numpy.pi * numpy.fft.fftfreq(cells)
    k2 = (2.0 * numpy.sin(0.5 * wave))**2
    spread = [numpy.array([abs(numpy.sum(w * numpy.exp(-1j * k * i)))**2 for k in wave]) for i, w in ((x, of_x), (y, of_y))]
    known, total = {}, 0.0
    for a in range(cells):
        for b in range(cells):
            share, both = spread[0][a] * spread[1][b], k2[a] + k2[b]
            if share < 1e-14 or (is_across and both == 0.0):
                continue
            if round(both, 10) not in known:
                if is_across:
                    answers = channel.flow(both, None, force)[1], 0.0 * force
                else:
                    shear = channel.shear(both, force)
                    answers = (channel.flow(both, force, None)[0] if both > 0.0 else shear), shear
                known[round(both, 10)] = [of_z @ mirrored(u, z, is_across) for u in answers]
            first, second = known[round(both, 10)]
            part = 1.0 if is_across or both == 0.0 else k2[a] / both
            total += share * (part * first + (1.0 - part) * second)
    sigma = (width(knots)**2 * width(normal))**(1.0 / 3.0)
    free = 1.0 / (6.0 * numpy.pi**1.5 * sigma)
    return total / cells**2 / free, free, sigma


def by_formula(is_across, diameter, distance, sigma):
    """Eqs. (4) and (5)."""
    knots = max(diameter, LEAST_KNOTS)
    reach = distance / knots
    if is_across:
        h = 1.0 - 1.3 * numpy.exp(-0.78 * reach) + 1.6 / knots * numpy.exp(-1.75 * reach)
    else:
        h = 1.0 - 0.15 * numpy.exp(-0.55 * reach) - 0.5 / knots * numpy.exp(-1.4 * reach)
    far = (16.0 if is_across else 32.0) / (9.0 * numpy.pi)
    return numpy.sum(SHARES * (1.0 - numpy.exp(-far * h * WAVES / sigma * distance)))


def main():
    cells, height = [int(a) for a in sys.argv[1:3]] + [56, 44][len(sys.argv) - 1:]
    channel = Channel(height)
    print("force   D/dx  y/dx    G/G0  eq. (4)  drag left off")
    for is_across in (False, True):
        for diameter in (0.5, 1.0, 1.5, 2.0, 2.5):
            for distance in sorted({max(0.5 * diameter, 0.5), diameter, 1.5 * diameter, 2.0 * diameter, 3.0 * diameter}):
                found, free, sigma = mobility(is_across, diameter, distance, cells, channel)
                said = by_formula(is_across, diameter, distance, sigma)
                left = 1.0 / (1.0 + 3.0 * numpy.pi * diameter * free * (found - said)) - 1.0
                print(f"{'across' if is_across else 'along ':6}  {diameter:4.2f}  {distance:4.2f}  {found:6.4f}   {said:6.4f}  {100.0 * left:+9.2f} %", flush=True)


if __name__ == "__main__":
    main()

"""Surfaces for both codes: binary STL in metres."""

import math
import struct


def write(path, triangles):
    with open(path, "wb") as out:
        out.write(bytes(80) + struct.pack("<I", len(triangles)))
        for a, b, c in triangles:
            u = [b[k] - a[k] for k in range(3)]
            v = [c[k] - a[k] for k in range(3)]
            n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            size = math.sqrt(sum(x * x for x in n))
            out.write(struct.pack("<12fH", *[x / size for x in n], *a, *b, *c, 0))


def strip(lower, upper):
    """Triangles between two open polygons of as many points."""
    faces = []
    for n in range(len(lower) - 1):
        faces += [(lower[n], upper[n], upper[n + 1]), (lower[n], upper[n + 1], lower[n + 1])]
    return faces


def ring(radius, z, segments):
    return [(radius * math.cos(2 * math.pi * n / segments),
             radius * math.sin(2 * math.pi * n / segments), z) for n in [*range(segments), 0]]


def lid(hole, radius, z, thickness, segments=64):
    """A flat plate with a round hole, closed: top at z."""
    top, bottom = z, z - thickness
    r = {(k, h): ring(k, h, segments) for k in (hole, radius) for h in (top, bottom)}
    return (strip(r[hole, top], r[radius, top])[::1] + strip(r[radius, bottom], r[hole, bottom]) +
            strip(r[radius, top], r[radius, bottom]) + strip(r[hole, bottom], r[hole, top]))


def belt_top(head_x, z, y):
    back, front = [(0.0, y[0], z), (head_x, y[0], z)], [(0.0, y[1], z), (head_x, y[1], z)]
    return strip(back, front)


def pulley(x, z, radius, y, segments=180):
    """The half of a drum that carries the belt, facets of one degree."""
    arc = [(x + radius * math.sin(math.pi * n / segments), z + radius * math.cos(math.pi * n / segments))
           for n in range(segments + 1)]
    return strip([(a, y[0], b) for a, b in arc], [(a, y[1], b) for a, b in arc])

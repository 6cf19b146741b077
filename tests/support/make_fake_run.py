#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes an invented run of the transfer point, to look at the report without an hour of computing.

    make_fake_run.py DIR [--no-fluid] [--interrupted] [--no-grains]

The motion is made of closed forms (a belt, a parabola, a vortex under the belt), not of physics.
Needs python3-h5py; no test depends on it.
"""
import argparse
import json
import math
import pathlib

import h5py
import numpy as np

A = np.array([0.080, 0.0055, 0.200])  # where the belt meets the head pulley
AXIS = np.array([0.080, 0.158])
RADIUS, G, BELT = 0.042, 9.81, 0.8
CLASSES = np.array([10e-6, 300e-6, 420e-6, 500e-6, 600e-6])
SHARES = np.array([0.01, 0.2433, 0.2660, 0.2277, 0.2530])


def outside(x, z):
    return ~(((x <= AXIS[0]) & (np.abs(z - AXIS[1]) < RADIUS)) | (np.hypot(x - AXIS[0], z - AXIS[1]) < RADIUS))


def air(x, z, t):
    """A jet along the parabola, a boundary layer on the belt, an eddy below the belt."""
    grow = min(1.0, t / 0.3)
    drop = np.clip(0.2 - z, 0.0, None)
    path = A[0] + BELT * np.sqrt(2 * drop / G) * 0.95
    width = 0.006 + 0.11 * drop
    jet = np.exp(-(((x - path) / width) ** 2)) * (z < 0.205) * (x > 0.07)
    fall = np.sqrt(2 * G * drop) * 0.45
    u = jet * BELT * 0.5
    w = -jet * fall
    r = np.hypot(x - AXIS[0], z - AXIS[1])
    layer = np.exp(-((r - RADIUS) / 0.005)) * (x > AXIS[0])
    u += layer * BELT * (z - AXIS[1]) / r
    w -= layer * BELT * (x - AXIS[0]) / r
    flat = (x <= AXIS[0]) & (np.abs(z - AXIS[1]) >= RADIUS)
    sheet = np.exp(-(np.abs(z - AXIS[1]) - RADIUS) / 0.005) * flat
    u += sheet * BELT * np.sign(z - AXIS[1])
    for cx, cz, size, strength in ((0.055, 0.075, 0.035, 0.16), (0.215, 0.12, 0.05, -0.12)):
        dx, dz = x - cx, z - cz
        swirl = strength * np.exp(-(dx**2 + dz**2) / (2 * size**2)) / size
        u += -dz * swirl
        w += dx * swirl
    return u * grow, w * grow


def pressure(x, z, t):
    p = 0.0
    for cx, cz, size, depth in ((0.055, 0.075, 0.03, -0.32), (0.215, 0.12, 0.04, -0.22), (0.2, 0.01, 0.03, 0.4),
                                (0.13, 0.21, 0.03, -0.12)):
        p = p + depth * np.exp(-((x - cx) ** 2 + (z - cz) ** 2) / (2 * size**2))
    return p * min(1.0, t / 0.3) * (1 + 0.08 * math.sin(40 * t))


def grains(frames, end, rng):
    """Positions at every frame: on the belt, on the parabola, dust along the air."""
    rate = 38000.0
    n = int(rate * end)
    born = np.sort(rng.uniform(0, end, n))
    kind = rng.choice(5, n, p=SHARES)
    d = CLASSES[kind]
    x0 = rng.uniform(0.026, 0.034, n)
    y = rng.uniform(0.001, 0.010, n)
    height = rng.exponential(0.0014, n)
    height = np.minimum(height, 0.005) + d / 2
    reach = 1.0 - 0.000045 / np.maximum(d, 200e-6) + rng.normal(0, 0.012, n)
    loose = (kind == 0) & (rng.uniform(size=n) < 0.45)
    place = np.stack([np.full(n, 0.081), 0.2 + height], axis=1)
    alive = np.ones(n, bool)
    out = []
    last = 0.0
    for t in frames:
        age = t - born
        here = (age > 0) & alive
        fall_in = 0.06
        ride = np.clip(age - fall_in, 0, None)
        x = np.where(age < fall_in, x0 + 0.1 * age, x0 + 0.006 + BELT * ride * np.clip(ride / 0.04, 0.3, 1))
        z = np.where(age < fall_in, 0.2 + height + 0.02 * np.clip(1 - age / fall_in, 0, 1), 0.2 + height)
        off = x > A[0]
        flight = np.where(off, (x - A[0]) / BELT, 0)
        x = np.where(off, A[0] + BELT * flight * reach * np.exp(-0.12 * flight), x)
        z = np.where(off, 0.2 + height - 0.5 * G * flight**2, z)
        # Loose dust follows the air from a little way down the stream.
        free = loose & (flight > 0.0) & here
        steps = max(1, int((t - last) / 0.002))
        for _ in range(steps):
            u, w = air(place[:, 0], place[:, 1], t)
            move = np.stack([u, w - 0.008], axis=1) * (t - last) / steps
            target = place + np.where(free[:, None], move + rng.normal(0, 3e-4, (n, 2)), 0)
            ok = outside(target[:, 0], target[:, 1])
            place = np.where(ok[:, None], target, place)
        place = np.where(free[:, None], place, np.stack([x, z], axis=1))
        shown = place.copy()
        place[~free] = [0.081, 0.2]
        place[:, 1] = np.where(free, place[:, 1], 0.2 + height)
        alive &= ~(here & ((shown[:, 1] < 0) | (shown[:, 0] > 0.33) | (shown[:, 0] < 0)))
        keep = here & alive
        out.append((np.nonzero(keep)[0], shown[keep], y[keep], d[keep]))
        last = t
    return out, n


def write_h5(folder, frames, steps, with_fluid, with_grains):
    nx, ny, nz = 264, 9, 280
    x = (np.arange(nx) + 0.5) * 0.33 / nx
    z = (np.arange(nz) + 0.5) * 0.35 / nz
    X, Z = np.meshgrid(x, z)
    with h5py.File(folder / "results.h5", "w") as f:
        for k, (t, (ids, place, y, d)) in enumerate(zip(frames, steps)):
            if not with_grains:
                ids, place, y, d = ids[:0], place[:0], y[:0], d[:0]
            g = f.create_group(f"particles/{k:06d}")
            g.attrs["time"] = float(t)
            g["position"] = np.stack([place[:, 0], y, place[:, 1]], axis=1).astype("f4")
            g["velocity"] = np.zeros((len(ids), 3), "f4")
            g["diameter"] = d.astype("f4")
            g["weight"] = np.where(d < 1e-4, 0.05, 1.0)
            g["material"] = np.zeros(len(ids), "i4")
            g["id"] = ids.astype("i8")
            if with_fluid:
                g = f.create_group(f"fluid/{k:06d}")
                g.attrs["time"] = float(t)
                u, w = air(X, Z, t)
                depth = (1 - 0.2 * np.linspace(-1, 1, ny) ** 2)[None, :, None]
                solid = ~outside(X, Z)
                u[solid], w[solid] = 0, 0
                v = np.stack([u[:, None, :] * depth, np.zeros((nz, ny, nx)), w[:, None, :] * depth], axis=3)
                g.create_dataset("velocity", data=v.astype("f4"), compression="gzip", compression_opts=1)
                p = np.broadcast_to(np.where(solid, 0, pressure(X, Z, t))[:, None, :], (nz, ny, nx)).astype("f4")
                g.create_dataset("pressure", data=p, compression="gzip", compression_opts=1)
        if with_fluid:
            f["fluid"].attrs["origin"] = [0.0, 0.0, 0.0]
            f["fluid"].attrs["spacing"] = [0.33 / nx, 0.011 / ny, 0.35 / nz]
            f["fluid"].attrs["count"] = [nx, ny, nz]
            open_share = np.broadcast_to(outside(X, Z)[:, None, :], (nz, ny, nx)).astype("f4")
            f.create_dataset("fluid/open_fraction", data=open_share, compression="gzip")


def outline():
    turn = np.linspace(math.pi / 2, -math.pi / 2, 60)
    ring = [[0.0, 0.2]] + [[AXIS[0] + RADIUS * math.cos(a), AXIS[1] + RADIUS * math.sin(a)] for a in turn] + [[0.0, 0.116]]
    return [{"body": "belt", "polygons": [ring]}]


def figure(value, unit, error=None, role="detail", quantity="", **more):
    entry = {"value": value, "unit": unit, "uncertainty": error, "role": role}
    return entry | ({"quantity": quantity} if quantity else {}) | more


def write_text(folder, status, end, released, inside, with_fluid, rng):
    drops = [0.02, 0.05, 0.1, 0.14]
    stream = {}
    quant = {"quantile_5": [], "median": [], "quantile_95": []}
    for h in drops:
        middle = BELT * math.sqrt(2 * h / G) * 0.95
        for name, p, value in (("quantile_5", 0.05, middle - 0.004 - 0.08 * h), ("median", 0.5, middle),
                               ("quantile_95", 0.95, middle + 0.003 + 0.05 * h)):
            stream[f"drop_{round(h * 1000)}_mm/{name}"] = figure(value, "m", 0.0003, "stream_quantile", "length", probability=p, drop_m=h)
            quant[name].append(value)
    mass = released * 1.18e-7
    left = released - inside
    summary = {
        "scenario": "transfer_point", "version": "0.1.0", "status": status, "threads": 2, "wall_s": 2874.3, "cpu_s": 5402.7,
        "peak_rss_bytes": 412345678, "simulated_s": end, "dem_steps": 351200, "fluid_steps": int(end * 1000),
        "particle_steps": 3312345678,
        "particles": {"emitted": released, "in_domain": inside, "left": left, "removed": 0, "max": inside + 310},
        "real_particles": {"emitted": released - 361.0, "in_domain": inside - 250.0, "left": left - 111.0, "removed": 0.0, "max": inside + 60.0},
        "mass_kg": {"emitted": mass, "in_domain": mass * inside / released, "left": mass - mass * inside / released, "removed": 0.0},
        "timers_s": {"contact": 1104.2, "neighbour": 311.8, "integration": 240.1, "voidage": 122.4, "fluid": 851.0,
                     "sensors": 33.1, "output": 41.9, "emit": 2.1},
        "state_sha256": "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08",
        "limits": {"void_fraction_floor": 1834, "cfl_substeps": 212, "overlap_above_5_percent": 0, "lost_grains": 0},
        "sensors": {
            "stream": stream,
            "left": {"observed_time": figure(0.15, "s", None, "observed_time", "time", towards="emission"),
                     "class_10_um/forward/number_rate": figure(61.9, "1/s", 37.0, "opening", "number_rate", direction="forward", diameters_m=[1e-5, 1e-5]),
                     "class_10_um/net/grams_per_tonne": figure(0.0143, "g/t", 0.0086, "opening", "mass_per_load", direction="net", diameters_m=[1e-5, 1e-5],
                                                               towards="emission")},
            "loose_dust": {"grams_per_tonne": figure(0.0137, "g/t", 0.0021, "stock", "mass_per_load", diameters_m=[0.0, 1e-4]), "mass_concentration": figure(3.1e-7, "kg/m3", 4.2e-8),
                           "number_concentration": figure(2.3e5, "1/m3", 3.1e4)},
            "carry_back": {name: figure(value, "g/t", error, "passage", "mass_per_load", direction="forward", towards="carry_back", **sizes)
                           for name, value, error, sizes in (("grams_per_tonne", 310.0, 25.0, {}),
                                                             ("class_10_um/grams_per_tonne", 0.0042, 0.0011, {"diameters_m": [1e-5, 1e-5]}),
                                                             ("class_300_um/grams_per_tonne", 309.9, 25.0, {"diameters_m": [3e-4, 3e-4]}))},
            "suction": {"found": figure(2, "1")} | {
                f"place_{n}/{name}": figure(value, unit, error, "low_pressure", quantity, index=n)
                for n, x, z, depth, scatter in ((1, 0.0551, 0.075, 0.392, 0.014), (2, 0.215, 0.12, 0.218, 0.02))
                for name, value, unit, error, quantity in (("x", x, "m", None, "x"), ("z", z, "m", None, "z"),
                                                           ("depth", depth, "Pa", scatter, "depth_of_pressure"))},
            "lip": {"forward/mass_rate": figure(0.00598, "kg/s", 2e-5)},
        },
    }
    (folder / "summary.json").write_text(json.dumps(summary, indent=1))
    t = np.arange(0, end, 0.001)
    ramp = np.clip(t / 0.35, 0, 1)
    columns = {
        "time [s]": t, "kinetic_energy [J]": 3.2e-4 * ramp + rng.normal(0, 3e-6, len(t)), "particles [-]": np.round(inside * ramp),
        "mass_emitted [kg]": 0.006 * t, "mass_in_domain [kg]": 0.006 * np.minimum(t, 0.33),
        "mass_left [kg]": 0.006 * np.clip(t - 0.33, 0, None),
        "lip/mass_flow [kg/s]": 0.006 * np.clip((t - 0.12) / 0.04, 0, 1) + rng.normal(0, 1.2e-4, len(t)) * (t > 0.12),
        "loose_dust/mass_concentration [kg/m3]": 3.1e-7 * ramp**3 + rng.normal(0, 1e-8, len(t)) * ramp,
        "loose_dust/mass_concentration_error [kg/m3]": 4e-8 * ramp,
        "carry_back/flux [kg/s]": 2.5e-11 * ramp**4 * (1 + 0.1 * rng.normal(0, 1, len(t))),
        "suction/lowest_pressure [Pa]": -0.39 * ramp + 0.01 * np.sin(40 * t),
    }
    rows = [",".join(columns)] + [",".join(f"{v:.9g}" for v in row) for row in zip(*columns.values())]
    (folder / "series.csv").write_text("\n".join(rows) + "\n")
    curves = [{"sensor": "stream", "title": "Trajectory of the stream", "x_label": "distance from A [m]",
               "y_label": "height above A [m]", "series": k, "x": v, "y": [-h for h in drops]} for k, v in quant.items()]
    size = np.linspace(-0.01, 0.02, 40)
    curves.append({"sensor": "lip", "title": "mass flux across the stream", "x_label": "height above the belt [m]",
                   "y_label": "flux [kg/(m2 s)]", "series": "steady mean", "x": list(size),
                   "y": list(18 * np.exp(-((size - 0.002) / 0.003) ** 2))})
    dot = "digraph run {\n" + "".join(f"  {a} -> {b};\n" for a, b in (
        ("emit", "voidage"), ("voidage", "fluid"), ("fluid", "dem"), ("dem", "publish"), ("publish", "sensors"),
        ("publish", "health"), ("publish", "writer"))) + "}\n"
    report = {"title": "Sand leaving a belt at 0.8 m/s", "curves": curves, "outline": outline(), "classes": list(CLASSES),
              "tables": [{"sensor": "suction", "title": "Places of low pressure", "columns": ["rank", "x [m]", "z [m]", "p [Pa]"],
                          "rows": [[1, 0.055, 0.075, -0.392], [2, 0.215, 0.12, -0.218]]}], "graph_dot": dot}
    (folder / "report.json").write_text(json.dumps(report))
    scenario = pathlib.Path(__file__).parents[2] / "scenarios" / "transfer_point.yaml"
    text = scenario.read_text() if scenario.exists() else "name: transfer_point\n"
    (folder / "scenario.yaml").write_text(text)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    for flag in ("--no-fluid", "--interrupted", "--no-grains"):
        parser.add_argument(flag, action="store_true")
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(7)
    end = 0.44 if args.interrupted else 0.7
    frames = np.arange(0, end + 1e-9, 0.02)
    steps, released = grains(frames, end, rng)
    write_h5(args.folder, frames, steps, not args.no_fluid, not args.no_grains)
    write_text(args.folder, "interrupted" if args.interrupted else "finished", end, released, len(steps[-1][0]),
               not args.no_fluid, rng)


if __name__ == "__main__":
    main()

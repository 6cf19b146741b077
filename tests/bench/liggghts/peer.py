"""LIGGGHTS inputs for the cases of `compare` and `coupled_bed`, and its rate from the log."""

import re
import subprocess
import sys

LAW = "model hertz tangential history rolling_friction epsd2"


def write_grains(folder, grains, low, high):
    """grains: (diameter, x, y, z, vx, vy, vz)."""
    with open(folder / "grains.data", "w") as out:
        out.write(f"grains\n\n{len(grains)} atoms\n3 atom types\n\n")
        for axis, a, b in zip("xyz", low, high):
            out.write(f"{a:g} {b:g} {axis}lo {axis}hi\n")
        out.write("\nAtoms\n\n")
        for n, g in enumerate(grains):
            out.write(f"{n + 1} 1 {g[0]:.10g} 2650 {g[1]:.10g} {g[2]:.10g} {g[3]:.10g}\n")
        out.write("\nVelocities\n\n")
        for n, g in enumerate(grains):
            out.write(f"{n + 1} {g[4]:.10g} {g[5]:.10g} {g[6]:.10g} 0 0 0\n")


def write_input(folder, walls, pairs, step, skin, warm, steps, sides="f f f", every=None):
    """walls: lines with {law}; pairs: per property, sand with sand, belt, glass; sides: f, or p for periodic. With `every`, the number of
    grains is told every so many steps."""
    def matrix(name):
        sand, belt, glass = pairs[name]
        return f"{name} peratomtypepair 3 {sand} {belt} {glass} {belt} {belt} {belt} {glass} {belt} {glass}"

    lines = [
        "atom_style granular", "atom_modify map array sort 1000 0.0012", f"boundary {sides}",
        "newton off", "communicate single vel yes", "units si", "read_data grains.data",
        f"neighbor {skin} bin", "neigh_modify delay 0",
        "fix m1 all property/global youngsModulus peratomtype 5e7 5e7 5e7",
        "fix m2 all property/global poissonsRatio peratomtype 0.3 0.3 0.3",
        f"fix m3 all property/global {matrix('coefficientRestitution')}",
        f"fix m4 all property/global {matrix('coefficientFriction')}",
        f"fix m5 all property/global {matrix('coefficientRollingFriction')}",
        f"pair_style gran {LAW}", "pair_coeff * *", f"timestep {step:g}",
        "fix g all gravity 9.81 vector 0.0 0.0 -1.0",
        *[line.format(law=LAW) for line in walls], "fix i all nve/sphere",
        *(["thermo_style custom step atoms"] if every else []), f"thermo {every or steps}", "thermo_modify lost ignore", f"run {warm}", f"run {steps}"]
    (folder / "in.case").write_text("\n".join(lines) + "\n")


def log_of(folder):
    ran = subprocess.run(["liggghts", "-in", "in.case"], cwd=folder, capture_output=True, text=True)
    if ran.returncode != 0:
        sys.exit("LIGGGHTS stopped: " + "\n".join(ran.stdout.splitlines()[-5:]))
    return ran.stdout


def run(folder, count, steps, least_neighbours):
    """Million grain-steps per second of the second run in the log."""
    log = log_of(folder)
    seconds, left = re.findall(r"Loop time of ([0-9.eE+-]+) on 1 procs for \d+ steps with (\d+)",
                               log)[-1]
    found = int(re.findall(r"Total # of neighbors = (\d+)", log)[-1])
    if found < least_neighbours * count:
        sys.exit(f"LIGGGHTS found {found} neighbours of {count} grains; this is no comparison")
    return 1e-6 * int(left) * steps / float(seconds)

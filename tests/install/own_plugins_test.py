#!/usr/bin/env python3
"""A drag law, a contact law with history and a sensor with state, written as third parties write
them: `engine new-plugin`, a project of their own, nothing but the installed prefix."""

import json

from prefix import Prefix, arguments, check

SCENARIO = """
name: own_models
time: {end: 30 ms, fluid_step: 1 ms, output_every: 10 ms}
gravity: [0, 0, -9.81]
domain:
  min: [0, 0, 0]
  max: [20, 20, 20 mm]
  boundaries:
    left: {grains: wall, material: glass, air: {model: total_pressure}}
    right: {grains: wall, material: glass, air: {model: total_pressure}}
    front: {grains: wall, material: glass, air: {model: slip}}
    back: {grains: wall, material: glass, air: {model: slip}}
    bottom: {grains: wall, material: glass, air: {model: no_slip}}
    top: {grains: open, air: {model: no_slip}}
materials:
  sand: {density: 2500, young_modulus: 10 MPa, poisson_ratio: 0.3}
  glass: {density: 2500, young_modulus: 10 MPa, poisson_ratio: 0.3}
interactions:
  - between: [sand, sand]
    contact: {model: own_springs, stiffness: 1000 N/m, restitution: 0.5, friction: 0.4}
  - between: [sand, glass]
    contact: {model: own_springs, stiffness: 1000 N/m, restitution: 0.5, friction: 0.4}
emitters:
  drop: {model: feed, material: sand, mass_flow: 4 g/s, diameters: [1 mm], number_fractions: [1],
    min: [5, 5, 6 mm], max: [15, 15, 6 mm], velocity: [0, 0, -0.3 m/s]}
fluid: {cells: [10, 10, 10], density: 1.2, viscosity: 1.8e-5, momentum_set: I}
drag: {model: own_drag, exponent: 3}
voidage: {model: centre}
sensors:
  energy: {model: own_energy, steady_after: 10 ms}
"""

PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(own_models LANGUAGES CXX)
find_package(dust CONFIG REQUIRED)
dust_add_plugin(own_drag own_drag/own_drag.cpp)
dust_add_plugin(contact own_springs SOURCES own_springs/own_springs.cpp)
dust_add_plugin(own_energy own_energy/own_energy.cpp)
dust_add_plugin(forgetful forgetful.cpp)
"""


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


with Prefix(arguments()) as prefix:
    work = prefix.folder / "work"
    work.mkdir()
    for kind, name in (("drag", "own_drag"), ("contact", "own_springs"), ("sensor", "own_energy")):
        prefix.run(prefix.engine, "new-plugin", kind, name, cwd=work)
    # The same sensor without what it saves, to see that the comparisons below can fail.
    source = (work / "own_energy/own_energy.cpp").read_text()
    begin, end = source.index("  // 5. What a resumed run"), source.index(" private:")
    (work / "forgetful.cpp").write_text((source[:begin] + source[end:]).replace(
        '"own_energy.hpp"', '"own_energy/own_energy.hpp"').replace('"own_energy"', '"forgetful"'))
    (work / "CMakeLists.txt").write_text(PROJECT)
    (work / "own.yaml").write_text(SCENARIO)
    prefix.build(work, work / "build")
    plugins = ("--plugin-path", work / "build")

    listed = prefix.run(prefix.engine, "plugins", *plugins)
    for name in ("own_drag.so", "contact_own_springs.so", "own_energy.so"):
        check(name in listed, f"{name} is not listed:\n{listed}")
    check(str(prefix.options.build) not in listed, "the moved engine uses plugins of its old place")

    def numbers(file, group, name):
        return prefix.run(prefix.options.build + "/bin/read_numbers", file, group,
                          name).splitlines()[-1].split()

    def run(folder, end, *more):
        prefix.run(prefix.engine, "run", work / "own.yaml", "-o", work / folder, "--quiet",
                   "--set", f"time.end={end}", *plugins, *more)
        return summary(work / folder)

    whole = run("whole", "30 ms")
    told = json.loads(prefix.run(prefix.engine, "check", work / "own.yaml", "--json", *plugins))
    check(abs(told["largest_step_s"] / whole["dem_step_s"] - 1) < 1e-9,
          f"check tells a step of {told['largest_step_s']} s, the run takes {whole['dem_step_s']} s")
    run("parts", "24 ms", "--threads", "1")
    # Grains lie on the bottom by then, so a law without its history would go on in another way.
    history = numbers(work / "parts/checkpoint.h5", "parts/grains", "surfaces_history")
    check(any(float(h) != 0.0 for h in history), "no contact has a history where the run is cut")
    parts = run("parts", "30 ms", "--resume", "--threads", "2")
    check(whole["particles"]["in_domain"] > 50, "too few grains to try anything")
    check(whole["state_sha256"] == parts["state_sha256"], "the resumed run has other bits")
    check(whole["sensors"] == parts["sensors"], "the sensor forgot what it saw before")
    check(whole["sensors"]["energy"], "the sensor gave nothing")
    check((work / "whole/series.csv").read_text() == (work / "parts/series.csv").read_text(),
          "the series differ")
    # A sensor's own section of the report, its histogram and table, and its field in results.h5.
    report = json.loads((work / "whole/report.json").read_text())
    check([s["sensor"] for s in report["sections"]] == ["energy"], "the sensor heads no section")
    titles = [c["title"] for c in report["curves"] if c["sensor"] == "energy"]
    check(titles == ["Kinetic energy", "Energy per mass"], f"curves {titles}")
    check(report["sections"][0]["heading"] == "Motion of the grains", "the section has another heading")
    check("Motion of the grains" in (work / "whole/report.html").read_text(), "the section is not on the page")
    mass = report["summary"]["sensors"]["energy"]["mass"]
    check((mass["role"], mass["quantity"]) == ("stock", "mass"), f"the role of a figure is {mass}")
    energy = next(c for c in report["curves"] if c["title"] == "Energy per mass")
    check(len(energy["x"]) == 18 and energy["x"][1] == energy["x"][2] == -5, f"steps {energy['x']}")
    for folder in ("whole", "parts"):
        shape, origin, spacing, count, values = prefix.run(
            prefix.options.build + "/bin/read_numbers", work / folder / "results.h5",
            "sensors/000003/energy", "mass").splitlines()
        check(shape.split() == count.split() == ["8", "8", "8"], f"a field of {shape} cells")
        check(origin.split() == ["0", "0", "0"] and spacing.split() == ["0.0025"] * 3,
              f"the field stands at {origin}, {spacing}")
        total = sum(map(float, values.split()))
        in_domain = summary(work / folder)["mass_kg"]["in_domain"]
        check(abs(total / in_domain - 1) < 1e-5, f"{total} kg in the field, {in_domain} in all")

    forgetful = ("--set", "sensors.energy.model=forgetful")
    run("forgotten", "22 ms", *forgetful)
    forgotten = run("forgotten", "30 ms", "--resume", *forgetful)
    check(forgotten["state_sha256"] == whole["state_sha256"], "a sensor has changed the grains")
    check(forgotten["sensors"] != whole["sensors"], "a sensor without memory is not told apart")

    # Another drag is another run: the comparison can fail.
    other = run("other", "30 ms", "--set", "drag.exponent=1")
    check(other["state_sha256"] != whole["state_sha256"], "the own drag law has no effect")
    other = run("harder", "30 ms", "--set", "interactions[1].contact.restitution=0.9")
    check(other["state_sha256"] != whole["state_sha256"], "the own contact law has no effect")

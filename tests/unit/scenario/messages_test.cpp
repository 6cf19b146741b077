// SPDX-License-Identifier: Apache-2.0
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <algorithm>

namespace {

/// One mistake in the small scenario and the one line it shall give.
void check(const std::string& from, const std::string& to, const std::string& expected) {
  const Folder folder;
  const auto lines = problems(folder.write("s.yaml", changed(k_small, from, to)));
  CHECK_MESSAGE(lines == std::vector<std::string>{expected}, joined(lines));
}

/// As above, where more may follow from the mistake.
void check_among(const std::string& from, const std::string& to, const std::string& expected) {
  const Folder folder;
  const std::string all = joined(problems(folder.write("s.yaml", changed(k_small, from, to))));
  CHECK_MESSAGE(all.find(expected) != std::string::npos, all);
}

const std::string k_plate =
    "  plate: {enabled: false, shape: plate, material: glass, hinge: [10, 0, 40 mm], length: 5 mm, "
    "thickness: 1 mm, angle: 16 deg}\n";

/// Another body instead of the plate, in line 24, and what shall be told among the rest.
void check_body(const std::string& body, const std::string& expected, bool has_air = true) {
  const Folder folder;
  // One triangle: open on three sides.
  folder.write("open.stl", "solid a\n vertex 10 0 0\n vertex 11 0 0\n vertex 10 1 0\nendsolid\n");
  folder.write("not.stl", "hello");
  std::string text = changed(k_small, k_plate, "  " + body + "\n");
  if (!has_air) {
    const std::size_t fluid = text.find("fluid:");
    text = text.substr(0, fluid) + "fluid: none\n" + text.substr(text.find("sensors:"));
  }
  std::string all = joined(problems(folder.write("s.yaml", text)));
  for (std::size_t at = 0;
       (at = all.find(folder.path().string() + "/", at)) != std::string::npos;) {
    all.erase(at, folder.path().string().size() + 1);
  }
  CHECK_MESSAGE((expected.empty() ? all.empty() : all.find(expected) != std::string::npos), all);
}

}  // namespace

TEST_CASE("the small scenario shall be well") {
  const Folder folder;
  CHECK(joined(problems(folder.write("s.yaml", k_small))).empty());
}

TEST_CASE("a study shall be told to be one, not key by key") {
  const Folder folder;
  folder.write("s.yaml", k_small);
  const auto study = folder.write("study.yaml",
                                  "name: study\nbase: s.yaml\nvary: {seed: [1, 2]}\n"
                                  "measure: {mass: {quantity: mass, unit: kg}}\n");
  const auto lines = problems(study);
  REQUIRE_MESSAGE(lines.size() == 1, joined(lines));
  CHECK(lines[0] ==
        "study.yaml:2:1: error: this is a study, which varies the scenario of its "
        "'base': engine study " +
            study.generic_string() + " runs it, with --dry-run it is only checked");
  const auto calibration = problems(
      folder.write("calibration.yaml", "base: s.yaml\ncalibrate: {targets: {}, parameters: {}}\n"));
  REQUIRE_MESSAGE(calibration.size() == 1, joined(calibration));
  CHECK(calibration[0].starts_with("calibration.yaml:1:1: error: this is a study"));
}

TEST_CASE("what YAML misses shall be told with what to look for") {
  const Folder folder;
  const auto message_of = [&](const std::string& text) {
    return joined(problems(folder.write("s.yaml", text)));
  };
  CHECK(message_of("bodies:\n   a: {shape: box}\n  b: {shape: box}\n")
            .find(": this line or one above it is indented by other than those beside it") !=
        std::string::npos);
  CHECK(message_of("time: {end: 1 s\nname: a\n").find(": a '}' or a ',' is missing") !=
        std::string::npos);
  CHECK(message_of("time\n  end: 1 s\n").find(": the line above lacks its ':'") !=
        std::string::npos);
}

TEST_CASE("a surrogate or an overlong form shall be told to be no text, with its place") {
  const Folder folder;
  for (const std::string bytes : {"\xED\xA0\x80", "\xE0\x80\xAF"}) {
    const auto lines =
        problems(folder.write("s.yaml", "gravity: [0, 0, 0]\nname: a" + bytes + "\n"));
    REQUIRE(!lines.empty());
    CHECK(lines[0].starts_with("s.yaml:2:8: error: not a text in UTF-8"));
  }
}

TEST_CASE("a merge key shall be told to be none, with what does the same") {
  const Folder folder;
  const auto lines =
      problems(folder.write("s.yaml", "materials:\n  a: &a {density: 1}\n  b:\n    <<: *a\n"));
  const auto line = std::find_if(lines.begin(), lines.end(), [](const std::string& text) {
    return text.find("s.yaml:4:5: error: YAML's merge keys (<<) are not supported") !=
           std::string::npos;
  });
  REQUIRE(line != lines.end());
  CHECK(line->find("'like'") != std::string::npos);
  CHECK(joined(lines).find("unknown key '<<'") == std::string::npos);
}

TEST_CASE("a tab that indents a line shall be told where it stands, with the remedy") {
  const Folder folder;
  const auto message_of = [&](const std::string& text) {
    return joined(problems(folder.write("s.yaml", text)));
  };
  const std::string remedy =
      ": error: not valid YAML: a tab indents this line: write spaces instead";
  CHECK(
      message_of("name: a\ntime:\n\tend: 1 s\n\tfluid_step: 1 ms\n").find("s.yaml:3:1" + remedy) !=
      std::string::npos);
  CHECK(message_of("bodies:\n  a: {shape: box}\n \tspoon: {shape: box}\n")
            .find("s.yaml:3:2" + remedy) != std::string::npos);
  // Where brackets are open, tabs are none of its business.
  CHECK(message_of("bodies: {\n\ta: 1,\n\tb: [1\n").find("a tab") == std::string::npos);
}

TEST_CASE("an empty name shall be told where it stands") {
  check("grains: wall, material: glass, air: {model: no_slip}",
        "grains: wall, material: '', air: {model: no_slip}",
        "s.yaml:12:38: error: domain.boundaries.bottom.material: is empty");
  check("material: glass, hinge", "material: glass, frame: '', hinge",
        "s.yaml:24:65: error: bodies.plate.frame: is empty");
}

TEST_CASE("a value out of range shall be told as the contract writes it") {
  check("restitution: 0.9, friction: 0.5", "restitution: 1.4, friction: 0.5",
        "s.yaml:19:50: error: interactions[0].contact.restitution: 1.4 is outside 0 < e <= 1");
  check("length: 5 mm", "length: -5 mm",
        "s.yaml:24:89: error: bodies.plate.length: -5 mm is outside length > 0 m");
  check("poisson_ratio: 0.3}\n  glass", "poisson_ratio: 0.6}\n  glass",
        "s.yaml:15:63: error: materials.sand.poisson_ratio: 0.6 is outside -1 < nu <= 0.5");
}

TEST_CASE("an unknown key shall be told as the contract writes it, with the nearest one") {
  check_among("viscosity", "viscocity",
              "s.yaml:37:3: error: unknown key 'viscocity' in fluid; did you mean 'viscosity'?");
  check("sensors:", "sensor:",
        "s.yaml:40:1: error: unknown key 'sensor' in the scenario; did you mean 'sensors'?");
  check("length: 5 mm", "length: 5 mm, colour: red",
        "s.yaml:24:95: error: unknown key 'colour' in bodies.plate; its keys are: enabled, frame, "
        "material, group, shape, hinge, length, thickness, angle, motions, motion, remove, "
        "suction");
}

TEST_CASE("a key given twice shall be told with the first line") {
  check("  density: 1.2 kg/m3\n", "  density: 1.2 kg/m3\n  density: 1.3\n",
        "s.yaml:37:3: error: duplicate key 'density': already given in line 36");
}

TEST_CASE("a missing key shall be told with what it is for") {
  check(
      "  density: 1.2 kg/m3\n", "",
      "s.yaml:34:1: error: fluid: missing key 'density' (number in kg/m3: Density of the fluid.)");
  check("gravity: [0, 0, -9.81]\n", "",
        "s.yaml:1:1: error: missing key 'gravity' (vector [x, y, z] in m/s2: Acceleration of "
        "gravity; [0, 0, 0] for none.)");
  check("drag: {model: gidaspow}\n", "", "s.yaml:1:1: error: missing key 'drag' ({model: ...})");
  check("front: {grains: wall, material: glass, air: {model: slip}}",
        "front: {grains: wall, material: glass}",
        "s.yaml:10:5: error: domain.boundaries.front: missing key 'air' (condition of the air: "
        "{model: ...})");
}

TEST_CASE("a value of another kind shall be told with the kind expected") {
  check("cells: [20, 2, 10]", "cells: 20",
        "s.yaml:35:10: error: fluid.cells: a vector [x, y, z] is expected, not '20'");
  check("cells: [20, 2, 10]", "cells: [20, 2]",
        "s.yaml:35:10: error: fluid.cells: a vector [x, y, z] is expected, not a list of 2");
  check("cells: [20, 2, 10]", "cells: [20, 2, 0]",
        "s.yaml:35:18: error: fluid.cells: 0 is outside 1 <= cells <= 100000");
  check("cells: [20, 2, 10]", "cells: [20, 2, 10.5]",
        "s.yaml:35:10: error: fluid.cells: 10.5 is not a whole number of cells");
  check_among("cells: [20, 2, 10]", "cells: [20000, 20000, 10]",
              "s.yaml:35:10: error: fluid.cells: 4e+09 cells; at most 2e+08 can be counted");
  check("time: {end: 1 s, fluid_step: 1 ms, output_every: 20 ms}", "time: 1 s",
        "s.yaml:2:7: error: time: a map of keys is expected, not '1 s'");
  check("drag: {model: gidaspow}", "drag: gidaspow",
        "s.yaml:38:7: error: drag: a map of keys is expected, not 'gidaspow': write {model: "
        "gidaspow}");
  check("enabled: false", "enabled: no",
        "s.yaml:24:20: error: bodies.plate.enabled: 'no' is not true or false: write false");
  check("end: 1 s", "end: .inf", "s.yaml:2:13: error: time.end: .inf is not a finite number");
  check("end: 1 s", "end: soon",
        "s.yaml:2:13: error: time.end: a time (s, ms, min, h) is expected, not 'soon'");
  check("end: 1 s", "end: 010",
        "s.yaml:2:13: error: time.end: '010' could be read as an octal number: leave out the "
        "leading zero and write 10");
  check("end: 1 s",
        "end:", "s.yaml:2:8: error: time.end: a time (s, ms, min, h) is expected, not nothing");
  check("density: 1.2 kg/m3", "density: 1.2 kg",
        "s.yaml:36:12: error: fluid.density: 'kg' is the unit of a mass: a density is expected "
        "(kg/m3, g/cm3, t/m3)");
  check("friction: 0.1", "friction: 0.1 m",
        "s.yaml:20:39: error: interactions[0].rolling.friction: 'm' does not belong here: a bare "
        "number is expected, without a unit");
}

TEST_CASE("an unknown model shall be told with the nearest and all there are") {
  check("gidaspow", "gidaspov",
        "s.yaml:38:15: error: drag.model: unknown drag model 'gidaspov'; did you mean 'gidaspow'? "
        "(drag models: gidaspow)");
  check("shape: plate", "shape: ball",
        "s.yaml:24:34: error: bodies.plate.shape: unknown shape 'ball' (shapes: conveyor, "
        "belt_conveyor, plate, "
        "plane, box, cylinder, frustum, cone, disc, "
        "container, mesh)");
  check(
      "model: trajectory", "model: [1]",
      "s.yaml:41:19: error: sensors.stream.model: the name of a sensor model is expected, not a "
      "list (sensor models: box_concentration, carry_back, low_pressure, plane_flux, trajectory)");
}

TEST_CASE("a name of something that is not there shall be told with the nearest") {
  check("    material: sand", "    material: snad",
        "s.yaml:28:15: error: emitters.feed.material: there is no material 'snad'; did you mean "
        "'sand'?");
  check("shape: plate", "frame: tilted, shape: plate",
        "s.yaml:24:34: error: bodies.plate.frame: there is no frame 'tilted'");
  check("drops: [5, 10 mm]", "drops: [5, 10 mm], body: plat",
        "s.yaml:41:77: error: sensors.stream.body: there is no body 'plat'; did you mean 'plate'?");
  check("drops: [5, 10 mm]", "drops: [5, 10 mm], body: plate",
        "s.yaml:41:77: error: sensors.stream.body: the body 'plate' is switched off "
        "(enabled: false)");
}

TEST_CASE("a reference to a figure that is not there shall be told with the nearest") {
  const auto check_reference = [](const std::string& reference, const std::string& expected) {
    const Folder folder;
    std::string text = k_small;
    text += "references:\n  - " + reference + "\n";
    const std::string all = joined(problems(folder.write("s.yaml", text)));
    const auto line = std::to_string(std::count(text.begin(), text.end(), '\n'));
    CHECK_MESSAGE(all == "s.yaml:" + line + ":" + expected + "\n", all);
  };
  check_reference("{quantity: sensors.strem.angle, value: 1 deg, source: a}",
                  "16: error: references[0].quantity: there is no sensor 'strem'; did you mean "
                  "'stream'?");
  check_reference("{quantity: sensors.stream.angel, value: 1 deg, source: a}",
                  "16: error: references[0].quantity: the sensor 'stream' has no figure 'angel'; "
                  "did you mean 'angle'?");
  check_reference("{quantity: stream.angle, value: 1 deg, source: a}",
                  "16: error: references[0].quantity: 'stream.angle' is not of the form "
                  "sensors.NAME.FIGURE");
  check_reference("{quantity: sensors.stream.angle, value: 1 mm, source: a}",
                  "45: error: references[0].value: 'mm' is the unit of a length: the figure is in "
                  "deg");
  check_reference("{quantity: sensors.stream.count, value: 1 mm, source: a}",
                  "45: error: references[0].value: 'mm' is the unit of a length: the figure is in "
                  "bare numbers");
  check_reference("{quantity: sensors.stream.angle, value: 1 dog, source: a}",
                  "45: error: references[0].value: unknown unit 'dog': the figure is in deg");
  check_reference("{quantity: sensors.stream.angle, value: 1 deg, uncertainty: -1 deg, source: a}",
                  "65: error: references[0].uncertainty: -1 is below 0");
  check_reference("{quantity: sensors.stream.angle, source: a}",
                  "5: error: references[0]: missing key 'value' (the number, with its unit)");
  check_reference("{quantity: sensors.stream.angle, value: 1 deg, source: a, sorce: b}",
                  "63: error: unknown key 'sorce' in references[0]; did you mean 'source'?");
}

TEST_CASE("a reference curve that fits nothing shall be told with what there is") {
  const auto check_curve = [](const std::string& curve, const std::string& expected) {
    const Folder folder;
    std::string text = k_small;
    text += "reference_curves:\n  - " + curve + "\n";
    const std::string all = joined(problems(folder.write("s.yaml", text)));
    const auto line = std::to_string(std::count(text.begin(), text.end(), '\n'));
    CHECK_MESSAGE(all == "s.yaml:" + line + ":" + expected + "\n", all);
  };
  check_curve("{sensor: strem, x: [0, 1 s], y: [0, 1 deg], source: a}",
              "14: error: reference_curves[0].sensor: there is no sensor 'strem'; did you mean "
              "'stream'?");
  check_curve(
      "{sensor: stream, x: [0, 1 s], y: [0, 1 kg], source: a}",
      "38: error: reference_curves[0].y: the sensor 'stream' draws no curve of [kg] against "
      "[s]; it draws angle [deg] against time [s]; height [m] against distance [m]; share "
      "[1] against time [s]");
  check_curve("{sensor: stream, x: [0, 1, 2 s], y: [0, 1 deg], source: a}",
              "41: error: reference_curves[0].y: 2 numbers for 3 places; one for each is expected");
  check_curve("{sensor: stream, x: [0, 0, 2 s], y: [0, 1, 2 deg], source: a}",
              "25: error: reference_curves[0].x: the places shall rise from each to the next");
  check_curve("{sensor: stream, x: [0, 1 sec], y: [0, 1 deg], source: a}",
              "29: error: reference_curves[0].x: unknown unit 'sec'; behind the last number stands "
              "the unit of all, like s, mm or kg/m3");
  check_curve("{sensor: stream, x: [0 ms, 1 s], y: [0, 1 deg], source: a}",
              "26: error: reference_curves[0].x: one unit for the whole list, 's' or 'ms'");
  check_curve("{sensor: stream, x: 1 s, y: [0, 1 deg], source: a}",
              "25: error: reference_curves[0].x: a list of at least two numbers is expected, the "
              "last with the unit of all");
  check_curve("{sensor: stream, x: [0, 1 s], source: a}",
              "5: error: reference_curves[0]: missing key 'y' (the numbers, with their unit)");
}

TEST_CASE("a body that contradicts itself shall be told with a remedy") {
  check_body("lid: {shape: mesh, material: glass, unit: 1 mm, file: none.stl}",
             "s.yaml:24:57: error: bodies.lid.file: there is no file none.stl");
  check_body(
      "lid: {shape: mesh, material: glass, unit: 1 mm, file: open.stl}",
      "s.yaml:24:16: error: bodies.lid: the mesh open.stl is open: 3 edges have one triangle "
      "only, the first at (10.5 mm, 0 mm, 0 mm); close it where it was drawn, or give open: "
      "allowed if it is a thin sheet");
  check_body(
      "lid: {shape: mesh, material: glass, unit: 1 mm, file: not.stl}",
      "s.yaml:24:16: error: bodies.lid: not.stl is not an STL file (neither binary nor text)");
  check_body("lid: {shape: mesh, material: glass, unit: 1 mm, file: open.stl, open: allowed}", "");
  check_body("lid: {shape: box, material: glass, min: [0, 0, 0], max: [1, 0, 1 mm]}",
             "s.yaml:24:16: error: bodies.lid: max is not above min in each direction");
  check_body(
      "lid: {shape: cylinder, material: glass, base: [0, 0, 0], axis: [0, 0, 1], length: 1 mm, "
      "radius: -1 mm}",
      "bodies.lid.radius: -1 mm is outside R > 0 m");
}

TEST_CASE("what is wrong with a part that the command line chooses shall be told of that") {
  const Folder folder;
  folder.write("open.stl", "solid a\n vertex 10 0 0\n vertex 11 0 0\n vertex 10 1 0\nendsolid\n");
  folder.write("not.stl", "hello");
  folder.write("base.yaml", changed(k_small, k_plate,
                                    "  lid: {shape: mesh, material: glass, unit: 1 mm, file: "
                                    "open.stl, open: allowed}\n"));
  const auto file = folder.write("s.yaml", "include: base.yaml\nname: over\n");
  CHECK(joined(problems(file)).empty());
  const auto said = [&](const std::string& path, const std::string& value) {
    return joined(problems(file, {{path, value}}));
  };
  CHECK(said("bodies.lid.file", (folder.path() / "not.stl").string())
            .starts_with("--set bodies.lid.file: error: bodies.lid: "));
  CHECK(said("bodies.lid.open", "refused").starts_with("--set bodies.lid.open: error: bodies.lid"));
}

TEST_CASE("an empty list shall be told what may stand in it and what it means to leave it out") {
  check_body(
      "lid: {shape: container, material: glass, min: [0, 0, 0], max: [1, 1, 1 mm], thickness: 1 "
      "mm, open: []}",
      "bodies.lid.open: the list is empty: give at least one of left, right, front, back, bottom, "
      "top, or leave 'open' out, which means top");
}

TEST_CASE("a bare angle that only degrees make sense of shall be told with them") {
  const std::string trough =
      "lid: {shape: belt_conveyor, material: glass, head: [-2, 0, 0 m], tail: [-3, 0, 0 m], "
      "radius: 50 mm, thickness: 5 mm, width: 200 mm, trough_angle: ";
  check_body(trough + "35}",
             "bodies.lid.trough_angle: 35 is outside 0 <= beta <= 1.0471975511965976 rad: a bare "
             "number is in rad; is '35 deg' meant?");
  check_body(trough + "100 deg}", "bodies.lid.trough_angle: 100 deg is outside");
}

TEST_CASE("bodies that move, go or suck shall be taken in air and without, where they make sense") {
  const std::string plane =
      "lid: {shape: plane, material: glass, point: [0, 0, 0], normal: [0, 0, 1]";
  for (const bool has_air : {true, false}) {
    check_body(plane + ", motion: lift, velocity: [0, 0, 1 mm/s]}", "", has_air);
    check_body(plane + ", motions: [{model: belt, speed: 1 m/s}]}", "", has_air);
    check_body(plane + ", remove: {at: 1 s}}", "", has_air);
    check_body(plane + ", remove: {when_kinetic_energy_per_grain_below: 1e-9 J, after: 0.1 s}}", "",
               has_air);
    // Air that is sucked from a closed box must come from somewhere.
    check_body(plane + ", suction: {flow: 1 l/min, min: [0, 0, 0], max: [10, 10, 0 mm]}}",
               has_air ? "none of them gives way" : "", has_air);
  }
  check_body(plane + ", suction: {flow: 1 l/min, min: [0, 0, 0], max: [10, -10, 0 mm]}}",
             "bodies.lid.suction.max: y is below that of min");
  check_body(plane + ", suction: {flow: 1 l, min: [0, 0, 0], max: [10, 10, 0 mm]}}",
             "'l' is the unit of");
  check_body(plane + ", suction: {flow: 1 l/min, max: [10, 10, 0 mm]}}",
             "bodies.lid.suction: missing key 'min'");
  check_body(plane + ", suction: {flow: 1 l/min, min: [0, 0, 0], max: [10, 10, 0 mm], flo: 1}}",
             "did you mean 'flow'?");
  check_body(plane +
                 ", suction: {flow: 1 l/min, min: [0, 0, 0], max: [10, 10, 0 mm], times: [0, 1 s], "
                 "factors: [1]}}",
             "bodies.lid.suction: times and factors differ in length");
}

TEST_CASE("motions and removals that contradict themselves shall be told") {
  const std::string plane =
      "lid: {shape: plane, material: glass, point: [0, 0, 0], normal: [0, 0, 1]";
  check_body(plane + ", remove: {at: 1 s, when_kinetic_energy_per_grain_below: 1 uJ}}",
             "bodies.lid.remove: give at or when_kinetic_energy_per_grain_below, not both", false);
  check_body(plane + ", remove: {when_kinetic_energy_per_grain_below: 0}}",
             "bodies.lid.remove.when_kinetic_energy_per_grain_below: 0 is never reached; give an "
             "energy above 0 J");
  check_body(plane + ", remove: {}}",
             "bodies.lid.remove: give at or when_kinetic_energy_per_grain_below", false);
  check_body(plane + ", remove: {at: 1 s, after: 1 s}}",
             "bodies.lid.remove: after belongs to when_kinetic_energy_per_grain_below, not to at",
             false);
  check_body(plane + ", remove: {at: -1 s}}", "bodies.lid.remove.at: -1 s is outside at >= 0 s",
             false);
  check_body(plane + ", remove: {when_kinetic_energy_per_grain_below: 1 s}}",
             "'s' is the unit of a time: an energy is expected", false);
  check_body(plane + ", motion: belt, speed: 1, motions: [{model: belt, speed: 1}]}",
             "bodies.lid: give motion or motions, not both", false);
  const std::string cleated =
      "lid: {shape: belt_conveyor, material: glass, head: [-2, 0, 0 m], tail: [-3, 0, 0 m], "
      "radius: "
      "50 mm, thickness: 5 mm, width: 200 mm, cleat_height: 20 mm, cleat_thickness: 5 mm";
  check_body(cleated + ", cleat_spacing: 5 mm, motion: belt, speed: 1}",
             "bodies.lid: cleat_spacing is not longer than cleat_thickness");
  check_body(cleated + ", cleat_spacing: 100 mm, motion: belt, speed: 1}", "");
  check_body(
      cleated + ", cleat_spacing: 100 mm, motions: [{model: lift, velocity: [0, 0, 1 mm/s]}]}",
      "bodies.lid: cleats run on a belt that stays where it is: motion: belt alone");
  check_body(plane + ", motions: {model: belt, speed: 1}}",
             "bodies.lid.motions: a list of '- model: ...' is expected, not a map", false);
  check_body(plane + ", motions: [{model: belt, sped: 1}]}", "did you mean 'speed'?", false);
  check_body(
      "lid: {shape: cylinder, material: glass, base: [0, 0, 0], axis: [0, 0, 1], length: 1 mm, "
      "radius: 1 mm, motion: lift, velocity: [0, 0, 1]}",
      "the key 'radius' belongs to the shape and to the motion: give the motion as motions: "
      "[{model: ...}]",
      false);
}

TEST_CASE("a pair of materials that can meet without a law shall be told") {
  check("[glass, sand]", "[glass, glass]",
        "s.yaml:17:1: error: interactions: missing pair [sand, glass]: grains of emitter 'feed' "
        "meet the wall 'front'");
  check_among("[glass, sand]", "[sand, sand]",
              "s.yaml:21:5: error: interactions[1]: the pair [sand, sand] is already given in line "
              "18\n");
}

TEST_CASE("contradictory sides shall be told") {
  check("right: {grains: periodic, air: periodic}", "right: {grains: open, air: {model: slip}}",
        "s.yaml:8:5: error: domain.boundaries.left: periodic sides come in pairs: make right "
        "periodic too");
  check("left: {grains: periodic}", "left: {grains: periodic, air: {model: slip}}",
        "s.yaml:8:5: error: domain.boundaries.left: grains: periodic needs air: periodic");
  check("top: {grains: open, air: {model: total_pressure}}", "top: {grains: open, air: periodic}",
        "s.yaml:13:5: error: domain.boundaries.top: air: periodic needs grains: periodic");
  check("top: {grains: open,", "top: {grains: open, material: glass,",
        "s.yaml:13:25: error: domain.boundaries.top.material: only grains: wall has a material");
  check("bottom: {grains: wall, material: glass,", "bottom: {grains: wall,",
        "s.yaml:12:5: error: domain.boundaries.bottom: missing key 'material' (of the wall)");
}

TEST_CASE("a domain or steps that contradict each other shall be told") {
  check("max: [100, 10, 50 mm]", "max: [100, 0, 50 mm]",
        "s.yaml:6:8: error: domain.max: y = 0 m is not above that of domain.min, 0 m");
  check("output_every: 20 ms", "output_every: 2.5 ms",
        "s.yaml:2:50: error: time.output_every: 0.0025 s is not a multiple of fluid_step, 0.001 s");
  check("output_every: 20 ms", "output_every: 20 ms, dem_step: 2 ms",
        "s.yaml:2:67: error: time.dem_step: 0.002 s is longer than fluid_step, 0.001 s");
  check("end: 1 s", "end: 0.1 ms",
        "s.yaml:2:13: error: time.end: 0.0001 s is shorter than one fluid_step, 0.001 s");
  check("end: 1 s", "end: 1e300",
        "s.yaml:2:13: error: time.end: 1e+300 s is more than 1e15 times fluid_step, 0.001 s, which "
        "no run reaches: give a shorter time or a longer step");
  check("output_every: 20 ms", "output_every: 1e300",
        "s.yaml:2:50: error: time.output_every: 1e+300 s is more than 1e15 times fluid_step, 0.001 "
        "s, which no run reaches: give a shorter time or a longer step");
  check("cells: [20, 2, 10]", "cells: [500, 2, 10]",
        "s.yaml:39:18: error: voidage: the largest grain is 2.5 of the smallest cell's edges wide; "
        "'divided' is valid up to 1: take fewer cells or another rule");
}

TEST_CASE("an account that a run cannot keep shall be told with what to change") {
  const auto problems_with = [](const std::string& diameters) {
    const Folder folder;
    const std::string audited = changed(k_small, "gravity: [0, 0, -9.81]\n",
                                        "gravity: [0, 0, -9.81]\naudit: {energy: true}\n");
    return joined(problems(folder.write("s.yaml", changed(audited, "[300, 500 um]", diameters))));
  };
  CHECK(problems_with("[300, 500 um]") == "");
  CHECK(problems_with("[30, 500 um]")
            .starts_with("s.yaml:4:17: error: audit.energy: grains of 30 um, below an eighth of "
                         "the largest, step at rates of their own and exchange impulses that the "
                         "account of a step does not hold; give `time: {rates: single}` or leave "
                         "the account out"));
  check("gravity: [0, 0, -9.81]\n", "gravity: [0, 0, -9.81]\naudit: {enrgy: true}\n",
        "s.yaml:4:9: error: unknown key 'enrgy' in audit; did you mean 'energy'?");
}

TEST_CASE("regions of the fluid that cannot be shall be told") {
  const std::string line = "  density: 1.2 kg/m3\n";
  check(line,
        line +
            "  regions: {water: {min: [0, 0, 0], max: [1, 1, 0 m], density: 998, "
            "viscosity: 1 mPa s}}\n",
        "s.yaml:37:42: error: fluid.regions.water.max: z is not above that of min");
  check(line,
        line +
            "  regions: {water: {min: [0, 0, 1], max: [1, 1, 2 m], density: 998, "
            "viscosity: 1 mPa s}}\n",
        "s.yaml:37:13: error: fluid.regions.water: the region lies outside the domain along z");
  check_among(line, line + "  regions: {water: {min: [0, 0, 0], density: 998}}\n",
              "fluid.regions.water: missing key 'max'");
}

TEST_CASE("parameters that a model refuses together shall be told at the model") {
  check("number_fractions: [0.5, 0.5]", "number_fractions: [0.5]",
        "s.yaml:27:12: error: emitters.feed: diameters and number_fractions differ in length");
}

TEST_CASE("a unit on some components only shall be told") {
  check("min: [1, 1, 40 mm]", "min: [1, 1 mm, 40 mm]",
        "s.yaml:30:11: error: emitters.feed.min: '1' has no unit but others have: give each one "
        "its unit, or the last alone one for all");
  // Of many, the few with a unit are the odd ones.
  check("number_fractions: [0.5, 0.5]", "number_fractions: [0.5, 0.5, 1 K, 0.5, 0.5]",
        "s.yaml:33:34: error: emitters.feed.number_fractions: '1 K' has a unit but most others "
        "have none: give each one its unit, or the last alone one for all");
}

TEST_CASE("a wrong unit that the last component gives to all shall be told where it is written") {
  check("min: [1, 1, 40 mm]", "min: [1, 1,\n      40 furlong]",
        "s.yaml:31:7: error: emitters.feed.min: unknown unit 'furlong': a length is expected (m, "
        "mm, um, in, ft)");
}

TEST_CASE("all problems shall be told at once, in the order of the file") {
  const Folder folder;
  auto text = changed(k_small, "end: 1 s", "end: 1 m");
  text = changed(text, "viscosity: 18 uPa s", "viscosity: -1");
  text = changed(text, "density: 2650", "density: zero");
  text = changed(text, "gidaspow", "gidaspov");
  const auto lines = problems(folder.write("s.yaml", text));
  REQUIRE(lines.size() == 4);
  CHECK(lines[0].starts_with("s.yaml:2:"));
  CHECK(lines[1].starts_with("s.yaml:15:"));
  CHECK(lines[2].starts_with("s.yaml:37:"));
  CHECK(lines[3].starts_with("s.yaml:38:"));
}

TEST_CASE("names with control characters shall not break the line that tells of them") {
  const Folder folder;
  const auto reported =
      problems(folder.write("c.yaml", changed(k_small, "sensors:\n",
                                              "frames:\n  \"con\\tvey\\nor\": {origin: [0, 0]}\n"
                                              "sensors:\n")));
  REQUIRE_FALSE(reported.empty());
  for (const std::string& line : reported) {
    for (const char c : line) CHECK(static_cast<unsigned char>(c) >= 0x20);
  }
}

// SPDX-License-Identifier: Apache-2.0
// Where bodies, emitters and sensors may be: what the checks before a run say of it.
#include "base/error.hpp"
#include "unit/preflight/said.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace dust;

namespace {

/// A box of 100 x 50 x 200 mm, periodic along x, with a shelf that reaches beyond both ends.
const std::string k_shelf = R"(
name: shelf
time: {end: 0.1 s, fluid_step: 1 ms, output_every: 0.1 s}
gravity: [0, 0, -9.81]
domain:
  min: [0, 0, 0]
  max: [100, 50, 200 mm]
  boundaries:
    left: {grains: periodic}
    right: {grains: periodic}
    front: {grains: wall, material: sand}
    back: {grains: open}
    bottom: {grains: wall, material: sand}
    top: {grains: open}
materials:
  sand: {density: 2500, young_modulus: 5 MPa, poisson_ratio: 0.3}
interactions:
  - between: [sand, sand]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
bodies:
  shelf: {shape: box, material: sand, min: [-10, 0, 20 mm], max: [110, 50, 30 mm]}
emitters:
  feed: {model: feed, material: sand, mass_flow: 1 kg/s, min: [20, 10, 150 mm], max: [60, 40, 150 mm], velocity: [0, 0, -1 m/s], diameters: [4 mm], mass_fractions: [1]}
fluid: none
sensors:
  box: {model: box_concentration, min: [0, 0, 0], max: [50, 50, 50 mm]}
  plane: {model: plane_flux, point: [0, 0, 100 mm], normal: [0, 0, -1], min: [0, 0, 100 mm], max: [100, 50, 100 mm]}
)";

test::Said said(const std::vector<scenario::Override>& set) { return test::said_of(k_shelf, set); }

/// The one error, which holds all of `parts`; "" where it is so.
std::string problem(const std::vector<scenario::Override>& set,
                    const std::vector<std::string>& parts) {
  const test::Said all = said(set);
  if (all.errors.empty()) return "not refused";
  for (const std::string& part : parts) {
    if (all.errors.front().find(part) == std::string::npos) return all.errors.front();
  }
  return "";
}

}  // namespace

TEST_CASE("what lies where it should shall not be complained of") {
  CHECK(said({}).errors == std::vector<std::string>{});
  CHECK(said({}).warnings == std::vector<std::string>{});
}

TEST_CASE("a body beside the domain shall be warned of however near it is") {
  const auto is_missed = [](const std::string& min, const std::string& max) {
    const test::Said all = said({{"bodies.shelf.min", min}, {"bodies.shelf.max", max}});
    REQUIRE(all.errors.empty());
    return std::any_of(all.warnings.begin(), all.warnings.end(), [](const std::string& line) {
      return line.find("bodies.shelf: none of its surface is in the domain") != std::string::npos;
    });
  };
  CHECK(is_missed("[-10, 60, 20 mm]", "[110, 70, 30 mm]"));
  CHECK(is_missed("[-10, 0, 205 mm]", "[110, 50, 215 mm]"));
  CHECK_FALSE(is_missed("[-10, 40, 20 mm]", "[110, 70, 30 mm]"));
  // It lines the side.
  CHECK_FALSE(is_missed("[-10, 50, 20 mm]", "[110, 70, 30 mm]"));
}

TEST_CASE("a body thinner than a cell shall be warned of where spheres are resolved") {
  // Cells of 2.5 mm.
  const auto warnings = [](const scenario::Override& shelf) {
    const test::Said all =
        said({{"domain.boundaries.front.air", "{model: no_slip}"},
              {"domain.boundaries.back.air", "{model: static_pressure, pressure: 0}"},
              {"domain.boundaries.bottom.air", "{model: no_slip}"},
              {"domain.boundaries.top.air", "{model: static_pressure, pressure: 0}"},
              {"fluid", "{cells: [40, 20, 80], density: 970, viscosity: 0.37 Pa s}"},
              {"coupling", "{resolved: [sand]}"},
              {"emitters.feed",
               "{model: single, material: sand, diameters: [20 mm], "
               "positions: [[50, 25, 100 mm]]}"},
              shelf});
    CHECK(all.errors == std::vector<std::string>{});
    std::vector<std::string> thin;
    for (const std::string& line : all.warnings) {
      if (line.find("beyond the periodic sides") == std::string::npos) thin.push_back(line);
    }
    return thin;
  };
  const auto is_thin = [&](const scenario::Override& shelf, const std::string& thickness) {
    const auto all = warnings(shelf);
    return std::any_of(all.begin(), all.end(), [&](const std::string& line) {
      return line.find("bodies.shelf is " + thickness + " thick") != std::string::npos &&
             line.find("thinner than a cell (2.5 mm)") != std::string::npos;
    });
  };
  CHECK(is_thin({"bodies.shelf.max", "[110, 50, 22 mm]"}, "2 mm"));
  CHECK(is_thin({"bodies.shelf.max", "[110, 50, 20.2 mm]"}, "200 um"));
  CHECK(warnings({"bodies.shelf.max", "[110, 50, 22.5 mm]"}).empty());
  CHECK(warnings({"bodies.shelf.max", "[110, 50, 30 mm]"}).empty());
  CHECK(warnings({"bodies.shelf",
                  "{shape: cylinder, material: sand, base: [-10, 25, 40 mm], axis: [1, 0, 0], "
                  "length: 120 mm, radius: 8 mm}"})
            .empty());
}

TEST_CASE("a body that is taken away after the end shall be warned of") {
  const auto warnings = [](const std::string& removal) {
    const test::Said all = said({{"bodies.shelf.remove", removal}});
    CHECK(all.errors == std::vector<std::string>{});
    return all.warnings;
  };
  CHECK(warnings("{at: 0.09 s}").empty());
  const auto late = warnings("{at: 0.2 s}");
  REQUIRE(late.size() == 1);
  CHECK(late.front().ends_with(
      "warning: bodies.shelf.remove.at: 0.2 s is not before time.end, 0.1 s: the body stays for "
      "all of the run; give an earlier time or a later end"));
  CHECK(warnings("{when_kinetic_energy_per_grain_below: 1 nJ}").empty());
  CHECK(warnings("{when_kinetic_energy_per_grain_below: 1 nJ, after: 0.1 s}").size() == 1);
}

TEST_CASE("an outlet that grains arch over shall be warned of") {
  // Grains of 4 mm.
  const auto warned = [](const std::string& shape, const std::string& grains = "") {
    std::vector<scenario::Override> set{{"bodies.shelf", "{material: sand, " + shape + "}"}};
    if (!grains.empty()) set.push_back({"emitters.feed", grains});
    const test::Said all = said(set);
    REQUIRE(all.errors == std::vector<std::string>{});
    return std::count_if(all.warnings.begin(), all.warnings.end(), [](const std::string& line) {
      return line.find("they arch over it and the flow stops") != std::string::npos ||
             line.find("they lie on it and block it") != std::string::npos;
    });
  };
  const auto disc = [](const std::string& radius, const std::string& axis = "[0, 0, 1]") {
    return "shape: disc, centre: [50, 25, 50 mm], axis: " + axis +
           ", radius: 20 mm, hole_radius: " + radius + ", thickness: 2 mm";
  };
  CHECK(warned(disc("9.8 mm")) == 1);
  CHECK(warned(disc("9.8 mm", "[0, 0, -1]")) == 1);
  CHECK(warned(disc("9.9 mm")) == 0);
  CHECK(warned(disc("1.9 mm")) == 1);
  CHECK(warned(disc("0 mm")) == 0);
  CHECK(warned(disc("5 mm", "[1, 0, 0.1]")) == 0);  // upright: nothing falls through
  const auto funnel = [](const std::string& radii, const std::string& more = ", thickness: 1 mm") {
    return "shape: frustum, base: [50, 25, 50 mm], axis: [0, 0, 1], length: 30 mm, " + radii + more;
  };
  CHECK(warned(funnel("radius: 5 mm, end_radius: 20 mm")) == 1);
  CHECK(warned(funnel("radius: 10 mm, end_radius: 20 mm")) == 0);
  CHECK(warned(funnel("radius: 20 mm, end_radius: 5 mm")) == 0);      // a cap
  CHECK(warned(funnel("radius: 5 mm, end_radius: 20 mm", "")) == 0);  // solid
  // A grain alone builds no arch.
  const std::string one =
      "{model: single, material: sand, positions: [[50, 25, 150 mm]], diameters: [4 mm]}";
  CHECK(warned(disc("5 mm"), one) == 0);
  CHECK(warned(disc("1.9 mm"), one) == 0);
}

TEST_CASE("a body that fast grains may miss at periodic sides shall be warned of") {
  // Grains of 4 mm; between left and right 100 mm apart.
  const auto warnings = [](const std::string& from, const std::string& to) {
    const test::Said all = said({{"bodies.shelf.min", "[" + from + ", 0, 20 mm]"},
                                 {"bodies.shelf.max", "[" + to + ", 50, 30 mm]"}});
    CHECK(all.errors == std::vector<std::string>{});
    return std::count_if(all.warnings.begin(), all.warnings.end(), [](const std::string& line) {
      return line.find(
                 "bodies.shelf: reaches less than a grain's diameter beyond the periodic "
                 "sides left and right") != std::string::npos &&
             line.find("let it reach along x from -4 mm to 104 mm") != std::string::npos;
    });
  };
  CHECK(warnings("-2", "103") == 1);
  CHECK(warnings("-4", "103") == 1);
  CHECK(warnings("-4", "104") == 0);
}

TEST_CASE("a body that ends at a periodic side shall be refused with where it may end") {
  const std::string sides = "bodies.shelf: ends near the periodic sides left and right";
  const auto shelf = [](const std::string& from, const std::string& to) {
    return std::vector<scenario::Override>{{"bodies.shelf.min", "[" + from + ", 0, 20 mm]"},
                                           {"bodies.shelf.max", "[" + to + ", 50, 30 mm]"}};
  };
  CHECK(problem(shelf("0", "100"), {sides, "(x from 0 m to 100 mm)", "from -4 mm to 104 mm",
                                    "between 4 mm and 96 mm"}) == "");
  CHECK(problem(shelf("-10", "10"), {sides, "(x from -10 mm to 10 mm)"}) == "");
  CHECK(problem(shelf("50", "98"), {sides}) == "");
  CHECK(problem(shelf("-1", "101"), {sides}) == "");  // by less than a radius
  for (const auto& fine : {shelf("10", "90"), shelf("-2", "102"), shelf("-50", "-20")}) {
    CHECK(said(fine).errors == std::vector<std::string>{});
  }
  // Endless ones, and without grains.
  CHECK(said({{"bodies.shelf",
               "{shape: plane, material: sand, point: [0, 0, 20 mm], normal: [0, "
               "0, 1]}"}})
            .errors == std::vector<std::string>{});
}

TEST_CASE("a body that is not the same at both periodic sides shall be refused") {
  const std::string words = "bodies.shelf: is not the same at the periodic sides left and right";
  const auto slope = [](const std::string& normal) {
    return std::vector<scenario::Override>{
        {"bodies.shelf",
         "{shape: plane, material: sand, point: [50, 0, 20 mm], normal: " + normal + "}"}};
  };
  // Half a millimetre higher at one side than at the other, a 250th of what is let pass.
  CHECK(problem(slope("[-0.005, 0, 1]"), {words, "for a slope, incline gravity"}) == "");
  CHECK(said(slope("[-2e-5, 0, 1]")).errors == std::vector<std::string>{});
  CHECK(said(slope("[0, -0.3, 1]")).errors == std::vector<std::string>{});  // along y: unchanged
  // A beam that is turned a little about the vertical: its ends are not opposite.
  const auto beam = [](const std::string& angle) {
    return std::vector<scenario::Override>{
        {"frames.turned", "{origin: [50, 25, 25 mm], axis: [0, 0, 1], angle: " + angle + "}"},
        {"bodies.shelf",
         "{shape: box, material: sand, frame: turned, min: [-40, 10, 20 mm], max: [140, 40, 30 "
         "mm]}"}};
  };
  CHECK(said(beam("0 deg")).errors == std::vector<std::string>{});
  CHECK(problem(beam("1 deg"), {words}) == "");
}

TEST_CASE("a body shall go on through periodic sides where there is air without grains") {
  const auto shelf = [](const std::string& shape) {
    return std::vector<scenario::Override>{
        {"emitters", "{}"},
        {"sensors", "{}"},
        {"fluid", "{cells: [20, 10, 40], density: 1.2, viscosity: 18 uPa s}"},
        {"domain.boundaries.front.air", "{model: no_slip}"},
        {"domain.boundaries.back.air", "{model: total_pressure}"},
        {"domain.boundaries.bottom.air", "{model: no_slip}"},
        {"domain.boundaries.top.air", "{model: total_pressure}"},
        {"bodies.shelf", "{material: sand, " + shape + "}"}};
  };
  const auto box = [&](const std::string& from, const std::string& to) {
    return shelf("shape: box, min: [" + from + ", 0, 21 mm], max: [" + to + ", 50, 33 mm]");
  };
  const std::string ends = "bodies.shelf: ends near the periodic sides left and right";
  CHECK(problem(box("-10", "40"), {ends, "the air would find it cut off", "from 0 m to 100 mm",
                                   "between 0 m and 100 mm"}) == "");
  CHECK(problem(box("60", "120"), {ends}) == "");
  for (const auto& fine : {box("0", "100"), box("-10", "110"), box("10", "60"), box("0", "40")}) {
    CHECK(said(fine).errors == std::vector<std::string>{});
  }
  CHECK(problem(shelf("shape: plane, point: [50, 0, 21 mm], normal: [-0.1, 0, 1]"),
                {"bodies.shelf: is not the same at the periodic sides left and right",
                 "the air would find it cut off"}) == "");
  CHECK(said(shelf("shape: plane, point: [50, 0, 21 mm], normal: [0, -0.1, 1]")).errors ==
        std::vector<std::string>{});
}

TEST_CASE("a body that moves to a periodic side shall be refused with when") {
  const auto shelf = [](const std::string& velocity) {
    return std::vector<scenario::Override>{
        {"bodies.shelf",
         "{shape: box, material: sand, min: [10, 0, 20 mm], max: [50, 50, 30 mm], motion: "
         "translate, velocity: " +
             velocity + "}"}};
  };
  // 40 mm in 0.1 s, where it may go 46 mm.
  CHECK(said(shelf("[0.4, 0, 0]")).errors == std::vector<std::string>{});
  CHECK(problem(shelf("[0.8, 0, 0]"),
                {"bodies.shelf: after ", "it ends near the periodic sides"}) == "");
}

TEST_CASE("laws that reach through both periodic sides shall be refused") {
  const scenario::Override wet = {
      "interactions[0].cohesion",
      "{model: lubrication, viscosity: 1 mPa s, reach: 2.15}"};  // 2.15 mm, of R* = 1 mm
  const std::vector<scenario::Override> narrow = {{"domain.max", "[12.1, 50, 200 mm]"},
                                                  {"bodies.shelf.enabled", "false"},
                                                  {"emitters.feed.mass_flow", "0.1 kg/s"},
                                                  {"emitters.feed.min", "[2.5, 10, 150 mm]"},
                                                  {"emitters.feed.max", "[10, 40, 150 mm]"}};
  CHECK(said(narrow).errors == std::vector<std::string>{});
  auto both = narrow;
  both.push_back(wet);
  CHECK(problem(both, {"12.1 mm between the periodic sides left and right", "beyond touch"}) == "");
  CHECK(said({wet}).errors == std::vector<std::string>{});
  CHECK(said({wet}).warnings == std::vector<std::string>{});
}

TEST_CASE("a load on walls that a side and a body share the name of shall be refused") {
  const scenario::Override load = {"sensors.load", "{model: wall_load, walls: [bottom]}"};
  CHECK(said({load}).errors == std::vector<std::string>{});
  CHECK(problem({load,
                 {"bodies.bottom",
                  "{shape: box, material: sand, min: [20, 0, 60 mm], max: "
                  "[40, 50, 70 mm]}"}},
                {"sensors.load.walls", "'bottom' is a side of the domain and a body"}) == "");
}

TEST_CASE("a law that reaches farther than grains are thick shall be asked for its unit") {
  const test::Said drops =
      said({{"interactions[0].cohesion", "{model: lubrication, viscosity: 1 mPa s, reach: 10}"}});
  REQUIRE(drops.warnings.size() == 1);
  CHECK(drops.warnings[0].find("interactions[0].cohesion: reaches 10 mm beyond touch, farther than "
                               "the smallest grains are thick (4 mm)") != std::string::npos);
}

TEST_CASE("an emitter shall be told that its grains come in outside, or in something") {
  const auto at = [](const std::string& low, const std::string& high) {
    return std::vector<scenario::Override>{{"emitters.feed.min", low}, {"emitters.feed.max", high}};
  };
  CHECK(problem(at("[20, 10, 250 mm]", "[60, 40, 250 mm]"),
                {"emitters.feed: its grains would start beyond the side 'top'",
                 "be gone at once: move the emitter into the domain"}) == "");
  CHECK(problem(at("[20, 10, 27 mm]", "[60, 40, 27 mm]"),
                {"emitters.feed: its grains would start inside 'shelf'", "thrown out of it"}) ==
        "");
  const test::Said part = said(at("[20, 30, 150 mm]", "[60, 70, 150 mm]"));
  REQUIRE(part.warnings.size() == 1);
  CHECK(part.warnings[0].find("grains would start beyond the side 'back'") != std::string::npos);
  CHECK(problem(at("[20, -10, 150 mm]", "[60, 20, 150 mm]"), {"inside the side 'front'"}) == "");
}

TEST_CASE("a sensor that looks outside the domain shall be refused") {
  CHECK(problem({{"sensors.box.min", "[0, 0, 300 mm]"}, {"sensors.box.max", "[50, 50, 400 mm]"}},
                {"sensors.box.min: the box from (0, 0, 0.3) m to (0.05, 0.05, 0.4) m lies outside "
                 "the domain"}) == "");
  CHECK(problem({{"sensors.plane.point", "[0, 0, 50 mm]"}},
                {"sensors.plane.point: the plane through it does not meet the box"}) == "");
  CHECK(said({{"sensors.box.max", "[500, 50, 50 mm]"}}).errors == std::vector<std::string>{});
}

TEST_CASE("a lone point outside the domain shall be refused") {
  const auto load = [](const std::string& point) {
    return std::vector<scenario::Override>{
        {"sensors.load", "{model: belt_load, point: " + point +
                             ", direction: [1, 0, 0], length: 20 mm, width: 20 mm, height: 20 mm, "
                             "belt_speed: 1 m/s}"}};
  };
  CHECK(said(load("[20, 25, 30 mm]")).errors == std::vector<std::string>{});
  CHECK(problem(load("[20, 25, 30]"), {"sensors.load.point: (20, 25, 30) m lies outside the domain",
                                       "nothing is seen there"}) == "");
}

TEST_CASE("a stretch that ends outside the domain shall be refused with its end") {
  const auto load = [](const std::string& direction, const std::string& length) {
    return std::vector<scenario::Override>{
        {"sensors.load", "{model: belt_load, point: [20, 25, 30 mm], direction: " + direction +
                             ", length: " + length + ", width: 20 mm, height: 20 mm}"}};
  };
  // 80 mm are left along x, 25 mm along y; a direction's own length does not matter.
  CHECK(said(load("[1, 0, 0]", "80 mm")).errors == std::vector<std::string>{});
  CHECK(problem(load("[4, 0, 0]", "90 mm"),
                {"sensors.load.length: the stretch from (0.02, 0.025, 0.03) m ends at (0.11, "
                 "0.025, 0.03) m, outside the domain",
                 "make it shorter"}) == "");
  CHECK(problem(load("[0, -1, 0]", "80 mm"), {"sensors.load.length: the stretch"}) == "");
}

TEST_CASE("drops of a trajectory below the domain shall be refused with where that ends") {
  const auto drops = [](const std::string& all) {
    return std::vector<scenario::Override>{
        {"sensors.stream",
         "{model: trajectory, from: [20, 25, 150 mm], drops: " + all + ", steady_after: 90 ms}"}};
  };
  CHECK(said(drops("[50, 150 mm]")).errors == std::vector<std::string>{});
  CHECK(problem(drops("[50, 160 mm]"),
                {"sensors.stream.drops: 160 mm below (0.02, 0.025, 0.15) m lies below the domain",
                 "which ends 150 mm below it", "leave it out"}) == "");
}

TEST_CASE("a point in a body at which the air is asked shall be warned of") {
  const auto warnings = [](const std::string& place) {
    const test::Said all =
        said({{"fluid", "{cells: [10, 5, 20], density: 1.2, viscosity: 18 uPa s}"},
              {"domain.boundaries.front.air", "{model: no_slip}"},
              {"domain.boundaries.back.air", "{model: total_pressure}"},
              {"domain.boundaries.bottom.air", "{model: no_slip}"},
              {"domain.boundaries.top.air", "{model: total_pressure}"},
              {"drag", "{model: schiller_naumann}"},
              {"voidage", "{model: centre}"},
              {"sensors.tap", "{model: exposure, points: [[50, 25, 100 mm], " + place + "]}"}});
    CHECK(all.errors == std::vector<std::string>{});
    return std::count_if(all.warnings.begin(), all.warnings.end(), [](const std::string& line) {
      return line.find("sensors.tap.points: (0.05, 0.025, 0.025) m lies in the body 'shelf'") !=
             std::string::npos;
    });
  };
  CHECK(warnings("[50, 25, 60 mm]") == 0);
  CHECK(warnings("[50, 25, 25 mm]") == 1);
}

TEST_CASE("a trajectory along gravity shall be refused before the run") {
  const auto stream = [](const std::string& along) {
    return scenario::Override{
        "sensors.stream", "{model: trajectory, from: [20, 25, 150 mm], drops: [50 mm], along: " +
                              along + ", steady_after: 90 ms}"};
  };
  CHECK(said({stream("[1, 0, 1]")}).errors == std::vector<std::string>{});
  CHECK(problem({stream("[0, 0, 1]")}, {"sensors.stream: 'along' lies along gravity",
                                        "give the way that the belt runs"}) == "");
  CHECK(problem({stream("[1, 0, 0]"), {"gravity", "[0, 0, 0]"}},
                {"sensors.stream: needs gravity"}) == "");
}

TEST_CASE("a mesh smaller than a grain or a cell shall be asked for its unit") {
  // A sheet of 40 x 20 of its units.
  const std::string sheet =
      "solid a\n vertex 0 0 0\n vertex 40 0 0\n vertex 40 20 0\n"
      " vertex 0 0 0\n vertex 40 20 0\n vertex 0 20 0\nendsolid\n";
  const auto warned = [&](const std::string& unit, std::vector<scenario::Override> set) {
    const Folder folder;
    const auto mesh = folder.write("sheet.stl", sheet);
    set.emplace_back("bodies.sheet", "{shape: mesh, material: sand, file: " + mesh.string() +
                                         ", unit: " + unit +
                                         ", open: allowed, moved_by: [30, 10, 80 mm]}");
    const test::Said all = said(set);
    INFO((all.errors.empty() ? std::string() : all.errors.front()));
    REQUIRE(all.errors.empty());
    REQUIRE(all.warnings.size() < 2);
    return all.warnings.empty() ? std::string() : all.warnings[0];
  };
  CHECK(warned("1 mm", {}) == "");
  const std::string small = warned("1 um", {});
  CHECK(small.find("bodies.sheet: the mesh measures") != std::string::npos);
  CHECK(small.find("less than the smallest grain (4 mm); is it drawn in metres? Then give unit: 1 "
                   "m") != std::string::npos);
  // 4.8 mm: more than a grain, less than a cell of 10 mm.
  const std::vector<scenario::Override> air = {
      {"domain.boundaries.front.air", "{model: no_slip}"},
      {"domain.boundaries.back.air", "{model: static_pressure, pressure: 0}"},
      {"domain.boundaries.bottom.air", "{model: no_slip}"},
      {"domain.boundaries.top.air", "{model: static_pressure, pressure: 0}"},
      {"drag", "{model: gidaspow}"},
      {"voidage", "{model: centre}"},
      {"fluid", "{cells: [10, 5, 20], density: 1.2, viscosity: 18 uPa s}"}};
  CHECK(warned("1 mm", air) == "");
  CHECK(warned("0.12 mm", {}) == "");
  CHECK(warned("0.12 mm", air).find("less than a cell of the fluid (10 mm)") != std::string::npos);
}

TEST_CASE("a belt whose top runs away from its head shall be warned of") {
  const auto warned = [](const std::string& shape, const std::string& speed) {
    const test::Said all =
        said({{"bodies.belt", "{shape: " + shape +
                                  ", material: sand, head: [70, 25, 80 mm], tail: [30, 25, 80 mm], "
                                  "radius: 10 mm, thickness: 2 mm, width: 30 mm, motion: belt, "
                                  "speed: " +
                                  speed + "}"},
              {"domain.boundaries.left", "{grains: open}"},
              {"domain.boundaries.right", "{grains: open}"}});
    REQUIRE(all.errors == std::vector<std::string>{});
    return std::any_of(all.warnings.begin(), all.warnings.end(), [](const std::string& line) {
      return line.find(
                 "bodies.belt: the top of the belt runs at 1 m/s away from its head pulley") !=
             std::string::npos;
    });
  };
  CHECK_FALSE(warned("belt_conveyor", "1 m/s"));
  CHECK(warned("belt_conveyor", "-1 m/s"));
}

TEST_CASE("a stream that leaves the domain and meets nothing shall be warned of") {
  const auto warned = [](std::vector<scenario::Override> set) {
    set.emplace_back("bodies.shelf.min", "[-10, 30, 20 mm]");
    set.emplace_back("emitters.feed.max", "[60, 20, 150 mm]");
    set.insert(set.begin(), {"emitters.feed.mass_flow", "0.1 kg/s"});
    const test::Said all = said(set);
    INFO((all.errors.empty() ? std::string() : all.errors.front()));
    REQUIRE(all.errors.empty());
    return std::any_of(all.warnings.begin(), all.warnings.end(), [](const std::string& line) {
      return line.find("emitters.feed: its grains leave the domain after at most 0.1") !=
                 std::string::npos &&
             line.find("meet nothing on their way") != std::string::npos;
    });
  };
  CHECK_FALSE(warned({}));
  CHECK(warned({{"domain.boundaries.bottom", "{grains: open}"}}));
  // Dust goes where the air takes it.
  const std::vector<scenario::Override> air = {
      {"domain.boundaries.bottom", "{grains: open, air: {model: static_pressure, pressure: 0}}"},
      {"domain.boundaries.front.air", "{model: no_slip}"},
      {"domain.boundaries.back.air", "{model: no_slip}"},
      {"domain.boundaries.top.air", "{model: static_pressure, pressure: 0}"},
      {"drag", "{model: gidaspow}"},
      {"voidage", "{model: centre}"},
      {"fluid", "{cells: [10, 5, 20], density: 1.2, viscosity: 18 uPa s}"}};
  CHECK(warned(air));
  auto dust = air;
  dust.emplace_back("emitters.feed.diameters", "[10 um]");
  dust.emplace_back("emitters.feed.mass_flow", "1e-9 kg/s");
  CHECK_FALSE(warned(dust));
  // Gravity of the wrong sign.
  CHECK(warned({{"gravity", "[0, 0, 9.81]"}, {"emitters.feed.velocity", "[0, 0, -0.5 m/s]"}}));
}

TEST_CASE("grains shall be let in where a body has been taken away by then, and not before") {
  const auto from = [](const std::string& begin, const std::string& remove) {
    return std::vector<scenario::Override>{{"emitters.feed.min", "[20, 10, 27 mm]"},
                                           {"emitters.feed.max", "[60, 40, 27 mm]"},
                                           {"emitters.feed.begin", begin},
                                           {"bodies.shelf.remove", remove}};
  };
  CHECK(said(from("50 ms", "{at: 50 ms}")).errors == std::vector<std::string>{});
  CHECK(problem(from("40 ms", "{at: 50 ms}"), {"would start inside 'shelf'"}) == "");
}

TEST_CASE("a belt with cleats shall not be taken for a mesh from a file") {
  const std::string belt =
      "{shape: belt_conveyor, material: sand, tail: [-500, YY, 20 mm], head: [600, YY, 20 mm], "
      "width: 2 mm, thickness: 1 mm, radius: 10 mm, cleat_height: 1 mm, cleat_thickness: "
      "1 mm, cleat_spacing: 100 mm}";
  for (const std::string place : {"25", "5000"}) {
    std::string text = belt;
    for (std::size_t at = text.find("YY"); at != std::string::npos; at = text.find("YY")) {
      text.replace(at, 2, place);
    }
    CAPTURE(place);
    const test::Said all = said({{"domain.boundaries.left.grains", "open"},
                                 {"domain.boundaries.right.grains", "open"},
                                 {"bodies.shelf", text}});
    CHECK(all.errors == std::vector<std::string>{});
    for (const std::string& line : all.warnings) {
      CHECK(line.find("unit: 1 m") == std::string::npos);
    }
  }
}

TEST_CASE(
    "sensors that gravity or their directions leave without an axis shall be refused at once") {
  const std::string box = "min: [10, 10, 40 mm], max: [90, 40, 90 mm]";
  const std::vector<scenario::Override> sensors = {
      {"sensors.rise", "{model: bubbles, " + box + ", direction: [1, 1, 0]}"},
      {"sensors.heap", "{model: angle_of_repose, form: planar, direction: [0, 0, 1]}"},
      {"sensors.lost", "{model: spillage, min: [10, 10, 40 mm], max: [10, 40, 90 mm]}"}};
  const test::Said all = said(sensors);
  REQUIRE(all.errors.size() == 1);
  const std::string& text = all.errors.front();
  INFO(text);
  CHECK(std::count(text.begin(), text.end(), '\n') == 2);
  CHECK(text.find("error: sensors.rise: ") != std::string::npos);
  CHECK(text.find("bubbles needs a direction along one of the axes") != std::string::npos);
  CHECK(text.find("error: sensors.heap: angle_of_repose: 'direction' is not level") !=
        std::string::npos);
  CHECK(text.find("error: sensors.lost: gravity does not pull along x, through the level") !=
        std::string::npos);
  CHECK(problem({{"gravity", "[0, 0, 0]"}, {"sensors.sink", "{model: settling_velocity}"}},
                {"error: sensors.sink: settling_velocity needs a direction"}) == "");
  CHECK(problem({{"gravity", "[0, 0, 0]"}, {"sensors.bed", "{model: bed_height, base: [0, 0, 0]}"}},
                {"error: sensors.bed: bed_height needs a direction"}) == "");
  // Told once, in the words that know the remedy.
  const test::Said stream =
      said({{"gravity", "[0, 0, 0]"},
            {"sensors.stream", "{model: trajectory, origin: [50, 25, 100 mm]}"}});
  REQUIRE(stream.errors.size() == 1);
  CHECK(stream.errors.front().find("needs gravity") ==
        stream.errors.front().rfind("needs gravity"));
}

TEST_CASE("cells of a sensor beyond all memory shall be refused with their number") {
  CHECK(problem({{"sensors.pressed",
                  "{model: stress, min: [0, 0, 0], max: [100, 50, 100 mm], "
                  "cells: [1000, 1000, 1000]}"}},
                {"sensors.pressed: ", "'cells' makes 1000000000 cells", "at most 10000000"}) == "");
}

TEST_CASE(
    "a stream of more grains than anybody could follow shall be told at once, and not tried") {
  // Half of the mass in grains of 15 um: their placing for a look took all memory.
  const test::Said all = said({{"emitters.feed.diameters", "[15 um, 4 mm]"},
                               {"emitters.feed.mass_fractions", "[0.5, 0.5]"}});
  CHECK(all.errors == std::vector<std::string>{});
  CHECK(std::any_of(all.warnings.begin(), all.warnings.end(), [](const std::string& line) {
    return line.find("emitters.feed: brings some 1.1e+11 grains a second") != std::string::npos;
  }));
}

namespace {

bool is_warned(const std::vector<scenario::Override>& set, const std::string& text) {
  const test::Said all = said(set);
  REQUIRE(all.errors == std::vector<std::string>{});
  const auto found = std::any_of(all.warnings.begin(), all.warnings.end(), [&](const auto& line) {
    return line.find(text) != std::string::npos;
  });
  return found;
}

/// A belt of 40 mm whose top, at 92 mm, runs at 1 m/s to the right or, turned round, to the left.
std::vector<scenario::Override> with_belt(bool is_turned, std::vector<scenario::Override> more) {
  const std::string ends = is_turned ? "head: [30, 25, 80 mm], tail: [70, 25, 80 mm]"
                                     : "head: [70, 25, 80 mm], tail: [30, 25, 80 mm]";
  more.insert(more.end(), {{"bodies.belt", "{shape: belt_conveyor, material: sand, " + ends +
                                               ", radius: 10 mm, thickness: 2 mm, width: 30 mm, "
                                               "motion: belt, speed: 1 m/s}"},
                           {"domain.boundaries.left", "{grains: open}"},
                           {"domain.boundaries.right", "{grains: open}"}});
  return more;
}

}  // namespace

TEST_CASE("steps of grains too short for any run shall be refused") {
  CHECK(problem({{"time.dem_step", "2e-13 s"}},
                {"time.dem_step: a fluid step of 0.001 s would be more than 1e9 steps",
                 "leave dem_step out, or give a longer one"}) == "");
  CHECK(said({{"time.dem_step", "1e-9 s"}}).errors == std::vector<std::string>{});
}

TEST_CASE("wear of no wall shall be warned of") {
  const auto warned_by = [](const std::string& min, const std::string& max,
                            const std::string& walls, const std::string& text) {
    return is_warned({{"sensors.liner", "{model: wear, min: " + min + ", max: " + max + walls +
                                            ", cell: 5 mm, coefficient: 1e-4, hardness: 1 GPa}"}},
                     "sensors.liner: " + text);
  };
  const auto warned = [&](const std::string& min, const std::string& max) {
    return warned_by(min, max, "", "no wall has a part in the box");
  };
  const auto named = [&](const std::string& walls) {
    return warned_by("[20, 0, 25 mm]", "[60, 40, 35 mm]", ", walls: [" + walls + "]",
                     "none of its walls has a part in the box");
  };
  CHECK_FALSE(named("shelf"));
  CHECK_FALSE(named("front"));
  CHECK_FALSE(named("bottom, shelf"));
  CHECK(named("bottom"));
  CHECK(warned("[20, 10, 100 mm]", "[60, 40, 120 mm]"));
  CHECK(warned("[20, 10, 22 mm]", "[60, 40, 28 mm]"));  // inside the shelf
  CHECK_FALSE(warned("[20, 10, 25 mm]", "[60, 40, 35 mm]"));
  CHECK_FALSE(warned("[20, 0, 100 mm]", "[60, 40, 120 mm]"));  // the front
  CHECK(warned("[20, 10, 100 mm]", "[60, 50, 120 mm]"));       // the back is open
  CHECK_FALSE(warned("[20, 10, 0 mm]", "[60, 40, 10 mm]"));    // the bottom
}

TEST_CASE("the load of no belt, and of one that runs another way, shall be warned of") {
  const auto load = [](const std::string& point, const std::string& direction) {
    return scenario::Override{"sensors.load", "{model: belt_load, point: " + point +
                                                  ", direction: " + direction +
                                                  ", length: 20 mm, width: 30 mm, height: 20 mm}"};
  };
  const std::string none = "sensors.load: looks at no belt";
  CHECK(is_warned(with_belt(false, {load("[40, 25, 150 mm]", "[1, 0, 0]")}), none));
  CHECK_FALSE(is_warned(with_belt(false, {load("[40, 25, 92 mm]", "[1, 0, 0]")}), none));
  CHECK(is_warned(with_belt(false, {load("[50, 15, 92 mm]", "[0, 1, 0]")}),
                  "sensors.load: looks across the way that 'belt' runs there, 1 m/s"));
  CHECK(is_warned(with_belt(false, {load("[60, 25, 92 mm]", "[-1, 0, 0]")}),
                  "sensors.load: looks against the way that 'belt' runs there, 1 m/s"));
  CHECK_FALSE(
      is_warned(with_belt(true, {load("[60, 25, 92 mm]", "[-1, 0, 0]")}), "sensors.load: looks"));
  // The shelf stands: it has no way.
  CHECK_FALSE(is_warned({load("[40, 25, 30 mm]", "[0, 1, 0]")}, "sensors.load: looks"));
}

TEST_CASE("a stream that comes in against the way of the belt below shall be warned of") {
  const auto warned = [](bool is_turned, const std::string& z, const std::string& velocity) {
    return is_warned(
        with_belt(is_turned, {{"emitters.feed.mass_flow", "1 g/s"},
                              {"emitters.feed.min", "[35, 20, " + z + " mm]"},
                              {"emitters.feed.max", "[40, 30, " + z + " mm]"},
                              {"emitters.feed.velocity", velocity}}),
        "emitters.feed: its grains come in at 0.5 m/s against the way of 'belt' below them");
  };
  CHECK(warned(true, "100", "[0.5, 0, -0.5 m/s]"));
  CHECK_FALSE(warned(false, "100", "[0.5, 0, -0.5 m/s]"));
  CHECK_FALSE(warned(true, "100", "[0, 0, -0.5 m/s]"));
  CHECK_FALSE(warned(true, "190", "[0.5, 0, -0.5 m/s]"));  // from another belt, perhaps
}

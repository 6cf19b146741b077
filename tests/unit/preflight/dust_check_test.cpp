// SPDX-License-Identifier: Apache-2.0
#include "preflight/dust_check.hpp"
#include "base/error.hpp"
#include "support/approx.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace dust;

namespace {

/// A box of 1 x 0.2 x 1 m in cells of 0.1 m; a hood with its opening at z = 0.7 m from x = 0.3 to
/// 0.7 m; a feed of 10 mm below it.
const std::string k_text = R"(
name: hood
time: {end: 0.1 s, fluid_step: 1 ms, output_every: 0.1 s}
gravity: [0, 0, -9.81]
domain:
  min: [0, 0, 0 m]
  max: [1, 0.2, 1 m]
  boundaries:
    left: {grains: open, air: {model: total_pressure}}
    right: {grains: open, air: {model: total_pressure}}
    front: {grains: wall, material: steel, air: {model: slip}}
    back: {grains: wall, material: steel, air: {model: slip}}
    bottom: {grains: wall, material: steel, air: {model: no_slip}}
    top: {grains: wall, material: steel, air: {model: slip}}
materials:
  sand: {density: 2500, young_modulus: 5 MPa, poisson_ratio: 0.3}
  steel: {density: 7800, young_modulus: 5 MPa, poisson_ratio: 0.3}
interactions:
  - between: [sand, sand]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
  - between: [sand, steel]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
bodies:
  hood: {shape: box, material: steel, min: [0.2, 0, 0.7 m], max: [0.8, 0.2, 0.8 m],
    suction: {flow: 10 l/s, min: [0.3, 0, 0.7 m], max: [0.7, 0.2, 0.7 m]}}
emitters:
  feed: {model: feed, material: sand, mass_flow: 10 kg/s, min: [0.4, 0.05, 0.5 m], max: [0.6, 0.15, 0.5 m], velocity: [0, 0, -2 m/s], diameters: [10 mm], mass_fractions: [1]}
fluid: {cells: [10, 2, 10], density: 1.2, viscosity: 2e-5, momentum_set: I, initial_velocity: [0, 0, 0 m/s]}
drag: {model: gidaspow}
voidage: {model: centre}
)";

const registry::Registry& shipped() {
  static const registry::Registry& all = []() -> const registry::Registry& {
    static registry::Registry made;
    made.load({DUST_TEST_PLUGINS});
    return made;
  }();
  return all;
}

std::vector<std::string> warnings(const std::vector<scenario::Override>& set) {
  const Folder folder;
  return preflight::read_scenario(folder.write("hood.yaml", k_text), set, shipped()).warnings;
}

bool has(const std::vector<std::string>& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const auto& line) { return line.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("a suction whose box holds no part of its body shall be refused with file and line") {
  const auto message_of = [](const std::vector<scenario::Override>& set) {
    const Folder folder;
    try {
      static_cast<void>(
          preflight::read_scenario(folder.write("hood.yaml", k_text), set, shipped()));
    } catch (const base::UserError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  // One that sucks nothing, or blows, catches no dust.
  for (const char* flow : {"0 l/s", "-10 l/s"}) {
    CHECK(message_of({{"bodies.hood.suction.flow", flow}, {"dust", "{hoods: [hood]}"}})
              .find("dust.hoods[0]: 'hood' extracts nothing") != std::string::npos);
  }
  // 0.2 m below the body.
  const std::string below = message_of(
      {{"bodies.hood.suction", "{flow: 10 l/s, min: [0.3, 0, 0.5 m], max: [0.7, 0.2, 0.5 m]}"}});
  CHECK(below.find("error: bodies.hood.suction: no part of the body's surface lies between min and "
                   "max in the domain") != std::string::npos);
  CHECK(below.find("it is at (0.5, 0.1, 0.7) m") != std::string::npos);
  // Deep in it.
  CHECK(message_of({{"bodies.hood.suction.min", "[0.4, 0.09, 0.74 m]"},
                    {"bodies.hood.suction.max", "[0.5, 0.1, 0.76 m]"}}) != "");
  // A corner of a large box alone.
  CHECK(message_of({{"bodies.hood.suction.min", "[0.1, 0, 0.4 m]"},
                    {"bodies.hood.suction.max", "[0.201, 0.2, 0.701 m]"}})
            .empty());
  // Round all of it.
  CHECK(message_of({{"bodies.hood.suction.min", "[0, 0, 0 m]"},
                    {"bodies.hood.suction.max", "[1, 0.2, 0.9 m]"}})
            .empty());
  // On a face that lies outside the domain.
  CHECK(message_of({{"bodies.hood.max", "[0.8, 0.2, 1.4 m]"},
                    {"bodies.hood.suction.min", "[0.3, 0, 1.4 m]"},
                    {"bodies.hood.suction.max", "[0.7, 0.2, 1.4 m]"}})
            .find("no part of the body's surface") != std::string::npos);
  try {
    const Folder folder;
    static_cast<void>(preflight::read_scenario(
        folder.write("hood.yaml", changed(k_text, "min: [0.3, 0, 0.7 m], max: [0.7, 0.2, 0.7 m]",
                                          "min: [0.3, 0, 0.5 m], max: [0.7, 0.2, 0.5 m]")),
        {}, shipped()));
    FAIL("accepted");
  } catch (const base::UserError& e) {
    CHECK(std::string(e.what()).find("hood.yaml:25:5: error: bodies.hood.suction") !=
          std::string::npos);
  }
}

TEST_CASE("a suction whose opening has no area shall be refused with file and line") {
  const auto message_of = [](const std::string& corners) {
    const Folder folder;
    try {
      static_cast<void>(preflight::read_scenario(
          folder.write("hood.yaml", k_text),
          {{"bodies.hood.suction", "{flow: 10 l/s, " + corners + "}"}}, shipped()));
    } catch (const base::UserError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const auto has_text = [](const std::string& line, const std::string& text) {
    return line.find(text) != std::string::npos;
  };
  // A point and a line of the underside.
  const std::string point = message_of("min: [0.4, 0.1, 0.7 m], max: [0.4, 0.1, 0.7 m]");
  CHECK(
      has_text(point, "error: bodies.hood.suction: the opening has no width along x and y and z"));
  CHECK(has_text(point, "'max' must lie above 'min' along two axes at least"));
  CHECK(has_text(message_of("min: [0.4, 0, 0.7 m], max: [0.4, 0.2, 0.7 m]"),
                 "no width along x and z"));
  // Boxes beside and below an edge that reach no farther than to it, flat and not.
  const std::string edge = message_of("min: [0.1, 0, 0.7 m], max: [0.2, 0.2, 0.7 m]");
  CHECK(has_text(edge, "error: bodies.hood.suction: the box from min to max only touches"));
  CHECK(has_text(message_of("min: [0.1, 0, 0.6 m], max: [0.2, 0.2, 0.7 m]"), "only touches"));
  // A flat box across the sides of the hood meets them in lines.
  CHECK(has_text(message_of("min: [0.1, 0, 0.75 m], max: [0.9, 0.2, 0.75 m]"), "only touches"));
  // Boxes of which a face lies in one of the hood's, from either side; and the whole underside.
  CHECK(message_of("min: [0.3, 0, 0.6 m], max: [0.7, 0.2, 0.7 m]").empty());
  CHECK(message_of("min: [0.3, 0, 0.7 m], max: [0.7, 0.2, 0.75 m]").empty());
  CHECK(message_of("min: [0.2, 0, 0.7 m], max: [0.8, 0.2, 0.7 m]").empty());
}

TEST_CASE("an opening that another body covers shall be refused, with that body and the line") {
  const auto message_of = [](const std::string& cover) {
    const Folder folder;
    try {
      static_cast<void>(preflight::read_scenario(
          folder.write("hood.yaml", k_text),
          {{"bodies.cover", "{shape: box, material: steel, " + cover + "}"}}, shipped()));
    } catch (const base::UserError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string whole = message_of("min: [0.2, 0, 0.6 m], max: [0.8, 0.2, 0.7 m]");
  CHECK(whole.find("hood.yaml:25:5: error: bodies.hood.suction: 'cover' covers the opening") !=
        std::string::npos);
  // A third of it is free; or it is a cell before it.
  CHECK(message_of("min: [0.2, 0, 0.6 m], max: [0.6, 0.2, 0.7 m]").empty());
  CHECK(message_of("min: [0.2, 0, 0.55 m], max: [0.8, 0.2, 0.6 m]").empty());
}

TEST_CASE("an opening that lies over an emitter shall be told, with file and line") {
  CHECK_FALSE(has(warnings({}), "lies over it"));
  // Half of the feed's width below the hood's opening, 4 mm from it: a radius is 5 mm.
  const auto half = warnings({{"emitters.feed.min", "[0.5, 0.05, 0.696 m]"},
                              {"emitters.feed.max", "[0.9, 0.15, 0.696 m]"}});
  CHECK(has(half, "hood.yaml"));
  CHECK(has(half, "emitters.feed: bodies.hood.suction lies over it and draws out "));
  // Beside the opening, at the same height, nothing is drawn out.
  CHECK_FALSE(has(warnings({{"emitters.feed.min", "[0.82, 0.05, 0.696 m]"},
                            {"emitters.feed.max", "[0.9, 0.15, 0.696 m]"}}),
                  "lies over it"));
}

TEST_CASE("an emitter that an opening takes everything of shall be refused") {
  const std::vector<scenario::Override> below = {{"emitters.feed.min", "[0.4, 0.05, 0.696 m]"},
                                                 {"emitters.feed.max", "[0.6, 0.15, 0.696 m]"}};
  const auto with_flow = [&](const std::string& suction) {
    auto set = below;
    set.push_back({"bodies.hood.suction.flow", suction});
    set.push_back({"bodies.hood.suction.times", "[0, 1 s]"});
    return set;
  };
  CHECK_THROWS_WITH_AS(warnings(below), doctest::Contains("draws out all grains as they come in"),
                       base::UserError);
  // Whichever way the flow is written.
  auto turned = with_flow("-10 l/s");
  turned.push_back({"bodies.hood.suction.factors", "[-1, -1]"});
  CHECK_THROWS_WITH_AS(warnings(turned), doctest::Contains("draws out all grains as they come in"),
                       base::UserError);
  auto blown = with_flow("10 l/s");
  blown.push_back({"bodies.hood.suction.factors", "[-1, -1]"});
  CHECK_FALSE(has(warnings(blown), "lies over it"));
  // One that draws at some time is a hood.
  auto hood = with_flow("-0.1 l/s");
  hood.erase(hood.begin(), hood.begin() + 2);
  hood.push_back({"bodies.hood.suction.factors", "[-1, 1]"});
  hood.push_back({"dust", "{hoods: [hood], finer_than: 1 mm}"});
  CHECK_FALSE(has(warnings(hood), "extracts nothing"));
}

TEST_CASE("a hood in a side of the domain shall be looked at as well") {
  const std::vector<scenario::Override> hood = {
      {"bodies", "{}"},
      {"domain.boundaries.top",
       "{grains: wall, material: steel, air: {model: hood, flow: 10 l/s, min: [0.4, 0, 1 m], max: "
       "[0.6, 0.2, 1 m]}}"}};
  auto set = hood;
  set.push_back({"emitters.feed.min", "[0.3, 0.05, 0.996 m]"});
  set.push_back({"emitters.feed.max", "[0.7, 0.15, 0.996 m]"});
  CHECK(has(warnings(set), "domain.boundaries.top.air lies over it"));
  CHECK_FALSE(has(warnings(hood), "lies over it"));
}

TEST_CASE("an opening smaller than a face shall be asked for its speed, not for the face's") {
  const auto warned = [](const std::string& max) {
    const auto set = std::vector<scenario::Override>{
        {"bodies", "{}"},
        {"domain.boundaries.top",
         "{grains: wall, material: steel, air: {model: hood, flow: 100 l/s, min: [0.4, 0, 1 m], "
         "max: [" +
             max + ", 1 m]}}"}};
    return has(warnings(set), "domain.boundaries.top.air: drives the fluid at");
  };
  CHECK(warned("0.42 m, 0.02 m"));  // 250 m/s; 10 m/s over the face
  CHECK_FALSE(warned("0.45 m, 0.05 m"));
}

TEST_CASE("a hood that draws faster than any plant's shall be asked for its unit") {
  const auto warned = [](const std::string& flow) {
    return has(warnings({{"bodies.hood.suction.flow", flow}}),
               "bodies.hood.suction: " + flow + " through at most ");
  };
  CHECK(warned("9000 m3/h"));        // 31 m/s
  CHECK_FALSE(warned("7200 m3/h"));  // 25 m/s, as in a duct
  CHECK(has(warnings({{"bodies.hood.suction.flow", "9000 m3/h"}}),
            "31.2 m/s: hoods draw at 0.5 to 2.5 m/s through their face"));
  // Nozzles may blow so.
  CHECK_FALSE(has(warnings({{"bodies.hood.suction.flow", "-9000 m3/h"}}), "hoods draw"));
}

TEST_CASE("an opening about as wide as a cell shall be warned of, with the cells it takes") {
  const auto said = [](const std::string& min, const std::string& max) {
    return warnings({{"bodies.hood.suction.min", min}, {"bodies.hood.suction.max", max}});
  };
  const std::string text =
      "bodies.hood.suction: the opening is 120 mm wide along x, and cells of the fluid are 100 mm "
      "there: ";
  CHECK(has(said("[0.44, 0, 0.7 m]", "[0.56, 0.2, 0.7 m]"), text));
  CHECK(has(said("[0.44, 0, 0.7 m]", "[0.56, 0.2, 0.7 m]"), "take cells of 30 mm"));
  CHECK_FALSE(has(said("[0.42, 0, 0.7 m]", "[0.58, 0.2, 0.7 m]"), "the opening is"));
  const auto in_side = std::vector<scenario::Override>{
      {"bodies", "{}"},
      {"domain.boundaries.top",
       "{grains: wall, material: steel, air: {model: hood, flow: 10 l/s, min: [0.4, 0, 1 m], max: "
       "[0.6, 0.1, 1 m]}}"}};
  CHECK(has(warnings(in_side),
            "domain.boundaries.top.air: the opening is 100 mm wide along y, and cells"));
}

TEST_CASE(
    "dusty grains that rain onto a belt shall be hinted at feed zones, unless they have one") {
  const auto said = [](const std::string& speed, const std::string& zones) {
    return warnings(
        {{"materials.sand.dust_load", "[1 %]"},
         {"bodies.belt",
          "{shape: conveyor, material: steel, head: [0.95, 0.1, 0.3 m], tail: [0.05, 0.1, 0.3 m], "
          "radius: 40 mm, thickness: 10 mm, motion: belt, speed: " +
              speed + "}"},
         {"time.end", "1 s"},
         {"dust",
          "{field: {classes: [10 um], material: sand}, liberation: {model: energy, "
          "binding_energy: 2 MJ/kg}" +
              zones + "}"}});
  };
  const std::string hint = "emitters.feed: its grains rain one by one onto 'belt', which sets dust";
  CHECK(has(said("1 m/s", ""), hint));
  CHECK_FALSE(has(
      said("1 m/s", ", feed_zones: {onto_belt: {min: [0.3, 0, 0.3 m], max: [0.7, 0.2, 0.6 m]}}"),
      hint));
  CHECK_FALSE(has(warnings({}), hint));
}

TEST_CASE("means over fewer than two blocks shall be warned of") {
  const auto warned = [](const std::string& block) {
    return has(warnings({{"sensors.low",
                          "{model: low_pressure, averaging_after: 0.06 s, block: " + block + "}"}}),
               "sensors.low.block: the 0.04 s that are averaged hold fewer than two blocks");
  };
  CHECK(warned("0.03 s"));
  CHECK_FALSE(warned("0.02 s"));
  CHECK_FALSE(warned("0.004 s"));
}

TEST_CASE("the narrowest turn that dust follows shall be that of Stokes number 0.2") {
  // tau = 2500 * 1e-10 / (18 * 2e-5) = 0.694 ms; at 4 m/s: 0.694e-3 * 4 / 0.2 = 13.9 mm.
  CHECK(preflight::narrowest_turn(10e-6, 2500, 2e-5, 4.0) == test::approx(0.0138889).epsilon(1e-5));
}

TEST_CASE("a class of dust that does not follow the resolved fluid shall be told") {
  // The feed's 2 m/s and cells of 0.1 m: 0.2 m is the turn of 54 um, four cells that of 76 um.
  CHECK_FALSE(has(warnings({{"dust", "{field: {classes: [10, 70 um], material: sand}}"}}),
                  "drift by inertia"));
  const auto coarse = warnings({{"dust", "{field: {classes: [10, 80 um], material: sand}}"}});
  CHECK(has(coarse, "dust.field.classes: at 2 m/s dust of 80 um follows the fluid round turns"));
  CHECK_FALSE(has(coarse, "dust of 10 um"));
  // Without the drift there is none to be limited.
  CHECK_FALSE(
      has(warnings({{"dust", "{field: {classes: [80 um], material: sand, inertia: false}}"}}),
          "drift by inertia"));
}

TEST_CASE("a feed that begins or ends while rates of dust are taken shall be warned of") {
  const std::vector<scenario::Override> dusty = {
      {"materials.sand.dust_load", "[1 %]"},
      {"dust",
       "{steady_after: 60 ms, field: {classes: [10 um], material: sand}, liberation: "
       "{model: energy, binding_energy: 2 MJ/kg}}"}};
  const auto said = [&](const std::string& key, const std::string& time) {
    auto set = dusty;
    if (!key.empty()) set.push_back({key, time});
    return warnings(set);
  };
  CHECK_FALSE(has(said("", ""), "rates of dust"));
  CHECK(has(said("emitters.feed.end", "80 ms"),
            "emitters.feed: ends at 0.08 s, while rates of dust are taken, from 0.06 s to 0.1 s"));
  CHECK(has(said("emitters.feed.begin", "70 ms"), "emitters.feed: begins at 0.07 s, while rates"));
  CHECK_FALSE(has(said("emitters.feed.end", "50 ms"), "rates of dust"));
  CHECK_FALSE(has(said("emitters.feed.end", "100 ms"), "rates of dust"));
  CHECK_FALSE(has(warnings({{"emitters.feed.end", "80 ms"}}), "rates of dust"));
}

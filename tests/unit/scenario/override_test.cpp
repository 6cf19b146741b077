// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

using namespace dust;

TEST_CASE("settings shall reach values, lists, list elements and absent optional keys") {
  const auto setup = read(transfer_point(), {{"bodies.belt.speed", "0.4 m/s"},
                                             {"interactions[1].contact.friction", "0.1"},
                                             {"fluid.cells", "[132, 5, 140]"},
                                             {"fluid.cells[1]", "6"},
                                             {"bodies.plate.enabled", "true"},
                                             {"time.dem_step", "3e-8"},
                                             {"time.rates", "single"},
                                             {"coupling.one_way", "true"},
                                             {"seed", "7"},
                                             {"fluid.largest_cfl", "0.5"}})
                         .setup;
  CHECK(std::get<double>(setup.bodies[0].motions[0].values[0]) == 0.4);
  CHECK(std::get<double>(setup.interactions[1].contact.values[1]) == 0.1);
  CHECK(setup.fluid->cells == std::array<int, 3>{132, 6, 140});
  CHECK(setup.bodies.size() == 2);
  CHECK(setup.time.dem_step == 3e-8);
  CHECK(setup.time.rates_single);
  CHECK(setup.fluid->is_one_way);
  CHECK(setup.seed == 7);
  CHECK(setup.fluid->largest_cfl == 0.5);
}

TEST_CASE("a setting shall be able to add a whole thing") {
  const auto setup =
      read(transfer_point(), {{"bodies.lid",
                               "{shape: plate, material: plate, hinge: [1, 0, 1 mm], length: 1 mm, "
                               "thickness: 1 mm}"}})
          .setup;
  REQUIRE(setup.bodies.size() == 2);
  CHECK(setup.bodies[1].name == "lid");
}

TEST_CASE("a setting of an unknown path shall be refused with the nearest one") {
  const auto one = [](const std::string& path, const std::string& value) {
    const auto lines = problems(transfer_point(), {{path, value}});
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].starts_with("--set " + path + ": error: "));
    return lines[0];
  };
  CHECK(one("bodies.bellt.speed", "1").find("did you mean 'belt'?") != std::string::npos);
  CHECK(one("bodies.belt.sped", "1").find("did you mean 'speed'?") != std::string::npos);
  CHECK(one("fluid.viscocity", "1").find("did you mean 'viscosity'?") != std::string::npos);
  CHECK(one("tim.end", "1").find("did you mean 'time'?") != std::string::npos);
  CHECK(one("interactions[9].contact.friction", "1").find("has 4 elements") != std::string::npos);
  CHECK(one("gravity.x", "1").find("has no key 'x'") != std::string::npos);
  CHECK(one("time[0]", "1").find("is not a list") != std::string::npos);
  CHECK(one("time..end", "1").find("not the path of a key") != std::string::npos);
  CHECK(one("time.end", "").find("the value is missing") != std::string::npos);
  CHECK(one("time.end", "5 mm").find("a time is expected") != std::string::npos);
  CHECK(one("time.end", "[1").find("not valid YAML") != std::string::npos);
}

TEST_CASE("a file that is included by a setting shall be refused with the option that does it") {
  for (const std::string path : {"include", "include[0]"}) {
    const auto lines = problems(transfer_point(), {{path, "other.yaml"}});
    REQUIRE(lines.size() == 1);
    CHECK(lines[0] == "--set " + path +
                          ": error: a file cannot be included by a setting: use --set-file "
                          "other.yaml, which lies over the scenario");
  }
}

TEST_CASE("null in a file that lies over another shall take away what that gives") {
  const Folder folder;
  folder.write("s.yaml", k_small);
  const auto variant = [&](const std::string& text) {
    return folder.write("variant.yaml", "include: s.yaml\n" + text);
  };
  const auto open = variant(
      "domain: {boundaries: {bottom: {grains: open, material: null, air: {model: total_pressure}}}}"
      "\nsensors: {stream: ~}\n");
  const auto setup = read(open).setup;
  CHECK(setup.domain.sides[4].grains == scenario::GrainSide::open);
  CHECK(setup.sensors.empty());
  // A key left empty is a slip, not a wish.
  CHECK(joined(problems(variant("gravity:\n"))).find("gravity") != std::string::npos);
  CHECK(joined(problems(variant("gravity: null\n"))).find("missing key 'gravity'") !=
        std::string::npos);
}

TEST_CASE("a setting of null shall take away a key that is there, and only such a one") {
  const Folder folder;
  const auto file = folder.write("s.yaml", k_small);
  CHECK(read(file, {{"sensors.stream", "null"}}).setup.sensors.empty());
  CHECK(joined(problems(file, {{"sensors.strem", "null"}})) ==
        "--set sensors.strem: error: there is no 'strem' to take away in sensors; did you mean "
        "'stream'?\n");
  CHECK(joined(problems(file, {{"interactions[0]", "null"}})) ==
        "--set interactions[0]: error: an element of a list cannot be taken away: give "
        "interactions anew, without it\n");
}

TEST_CASE("files of settings shall lie over the scenario, single settings over them") {
  const Folder folder;
  const auto over = folder.write("over.yaml", "time: {end: 3 s}\nfluid: {density: 1.3}\n");
  const auto file = folder.write("s.yaml", k_small);
  const auto setup = read(file, {{"time.end", "4 s"}}, {over}).setup;
  CHECK(setup.time.end == 4);
  CHECK(setup.fluid->density == 1.3);
  const auto wrong = folder.write("wrong.yaml", "time:\n  ende: 3 s\n");
  const auto lines = problems(file, {}, {wrong});
  REQUIRE(lines.size() == 1);
  CHECK(lines[0] == "wrong.yaml:2:3: error: unknown key 'ende' in time; did you mean 'end'?");
}

TEST_CASE("everything written in full shall differ only where it was set") {
  const auto plain = read(transfer_point()).resolved_yaml;
  CHECK(read(transfer_point(), {{"time.end", "0.7 s"}}).resolved_yaml == plain);
  CHECK(read(transfer_point(), {{"time.end", "0.6 s"}}).resolved_yaml != plain);
}

TEST_CASE("an interaction shall be set by its pair, in either order") {
  for (const std::string pair : {"sand-belt", "belt-sand"}) {
    const auto setup =
        read(transfer_point(), {{"interactions." + pair + ".contact.friction", "0.1"}}).setup;
    CHECK(std::get<double>(setup.interactions[1].contact.values[1]) == 0.1);
    CHECK(setup.interactions.size() == 4);
  }
  const auto lines =
      problems(transfer_point(), {{"interactions.sand-bellt.contact.friction", "1"}});
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].find("no interaction 'sand-bellt'; did you mean 'sand-belt'?") !=
        std::string::npos);
}

TEST_CASE("an including file shall complete interactions pair by pair and add others") {
  const Folder folder;
  const auto base = text_of(transfer_point());
  folder.write("base.yaml", base);
  const auto file = folder.write("over.yaml",
                                 "include: base.yaml\n"
                                 "interactions:\n"
                                 "  - between: [belt, sand]\n"
                                 "    contact: {friction: 0.1}\n"
                                 "  - {between: [belt, plate], like: [sand, plate]}\n");
  const auto plain = read(transfer_point()).setup;
  const auto setup = read(file).setup;
  REQUIRE(setup.interactions.size() == 5);
  CHECK(std::get<double>(setup.interactions[1].contact.values[1]) == 0.1);
  CHECK(setup.interactions[1].contact.values[0] == plain.interactions[1].contact.values[0]);
  REQUIRE(setup.interactions[1].rolling);
  CHECK(setup.interactions[0].contact.values == plain.interactions[0].contact.values);
}

TEST_CASE("a pair that one file gives twice shall be refused, whatever that file includes") {
  const Folder folder;
  folder.write("base.yaml", text_of(transfer_point()));
  const auto lines = [&](const std::string& interactions) {
    return problems(
        folder.write("over.yaml", "include: base.yaml\ninteractions:\n" + interactions));
  };
  const auto twice = lines(
      "  - {between: [sand, belt], contact: {friction: 0.1}}\n"
      "  - {between: [belt, sand], contact: {friction: 0.2}}\n");
  REQUIRE(twice.size() == 1);
  CHECK(twice[0].ends_with(
      "over.yaml:4:5: error: interactions[4]: the pair [belt, sand] is already given in line 3"));
  // The same of a pair that the other file has not.
  const auto more = lines(
      "  - {between: [plate, belt], like: [sand, belt]}\n"
      "  - {between: [belt, plate], like: [sand, plate]}\n");
  REQUIRE(more.size() == 1);
  CHECK(more[0].ends_with("the pair [belt, plate] is already given in line 3"));
}

TEST_CASE("a pair shall be completed by another one it is like") {
  const Folder folder;
  std::string text = text_of(transfer_point());
  const std::string plate = "  - between: [sand, plate]\n";
  const std::size_t at = text.find(plate);
  REQUIRE(at != std::string::npos);
  const std::size_t end = text.find("  - between: [sand, glass]");
  const auto with = [&](const std::string& lines) {
    return folder.write("like.yaml", text.substr(0, at) + plate + lines + text.substr(end));
  };
  const auto setup = read(with("    like: [belt, sand]\n    contact: {friction: 0.2}\n")).setup;
  const auto& like = setup.interactions[2];
  CHECK(std::get<double>(like.contact.values[1]) == 0.2);
  CHECK(like.contact.values[0] == setup.interactions[1].contact.values[0]);
  REQUIRE(like.rolling);
  CHECK(like.rolling->values == setup.interactions[1].rolling->values);
  // What is written out stands by itself.
  CHECK(read(with("    like: [belt, sand]\n")).resolved_yaml.find("like") == std::string::npos);
  const auto wrong = [&](const std::string& lines) {
    const auto all = problems(with(lines));
    REQUIRE(!all.empty());
    return all.front();
  };
  CHECK(wrong("    like: [sand, bellt]\n").find("there is no interaction between") !=
        std::string::npos);
  CHECK(wrong("    like: [sand, plate]\n").find("in a circle") != std::string::npos);
  CHECK(wrong("    like: sand\n").find("two materials of another interaction") !=
        std::string::npos);
}

TEST_CASE("one component of a list shall be set without the unit of the others") {
  // min: [0, 0, 0], max: [330, 11, 350 mm]
  const auto max_with = [](const std::string& path, const std::string& value) {
    return read(transfer_point(), {{path, value}}).setup.domain.max;
  };
  const auto last = max_with("domain.max[2]", "0.36 m");
  CHECK(last.x == test::approx(0.33));
  CHECK(last.y == test::approx(0.011));
  CHECK(last.z == 0.36);
  const auto first = max_with("domain.max[0]", "40 cm");
  CHECK(first.x == test::approx(0.4));
  CHECK(first.y == test::approx(0.011));
  CHECK(first.z == test::approx(0.35));
  // A bare number is neither millimetres nor, silently, metres.
  for (const char* path : {"domain.max[0]", "domain.max[2]"}) {
    const auto lines = problems(transfer_point(), {{path, "0.4"}});
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].find("'0.4' has no unit but others have: give each one its unit") !=
          std::string::npos);
  }
}

TEST_CASE("a setting shall be able to exchange a model that has parameters") {
  const auto setup =
      read(transfer_point(), {{"domain.boundaries.left.air.model", "no_slip"}}).setup;
  CHECK(setup.domain.sides[0].air->name == "no_slip");
}

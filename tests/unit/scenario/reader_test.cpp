// SPDX-License-Identifier: Apache-2.0
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <numbers>

using namespace dust;

TEST_CASE("the transfer point shall be read as it is written") {
  const auto setup = read(transfer_point()).setup;
  CHECK(setup.name == "transfer_point");
  CHECK(setup.time.end == 0.7);
  CHECK(setup.time.fluid_step == 1e-3);
  CHECK(setup.time.output_every == 0.02);
  CHECK(setup.gravity == sdk::Vec3{0, 0, -9.81});
  CHECK(setup.domain.max == sdk::Vec3{0.33, 0.011, 0.35});
  REQUIRE(setup.domain.sides[0].air);
  CHECK(setup.domain.sides[0].air->name == "total_pressure");
  CHECK(setup.domain.sides[2].grains == scenario::GrainSide::wall);
  CHECK(setup.materials[static_cast<std::size_t>(setup.domain.sides[2].material)].name == "glass");
  REQUIRE(setup.materials.size() == 4);
  CHECK(setup.materials[0].properties.young_modulus == 5e7);
  REQUIRE(setup.interactions.size() == 4);
  CHECK(setup.interactions[0].rolling.has_value());
  CHECK_FALSE(setup.interactions[3].rolling.has_value());
  CHECK(std::get<double>(setup.interactions[1].contact.values[0]) == 0.5);
  REQUIRE(setup.bodies.size() == 1);
  CHECK(setup.bodies[0].name == "belt");
  CHECK(setup.bodies[0].frame == 0);
  REQUIRE(setup.bodies[0].motions.size() == 1);
  CHECK(std::get<double>(setup.bodies[0].motions[0].values[0]) == 0.8);
  REQUIRE(setup.emitters.size() == 1);
  REQUIRE(setup.fluid);
  CHECK(setup.fluid->cells == std::array<int, 3>{264, 9, 280});
  CHECK(setup.drag->name == "gidaspow");
  CHECK(setup.sensors.size() == 5);
  CHECK(setup.domain.sides[0].where.line > 0);
}

TEST_CASE("a unit on the last component alone shall hold for all, and each may have its own") {
  const Folder folder;
  const auto with = [&](const std::string& vector) {
    return read(folder.write("s.yaml", changed(k_small, "[100, 10, 50 mm]", vector)))
        .setup.domain.max;
  };
  const sdk::Vec3 expected{0.1, 0.01, 0.05};
  CHECK(with("[100, 10, 50 mm]") == expected);
  CHECK(with("[10 cm, 10 mm, 0.05 m]") == expected);
  CHECK(with("[0.1, 0.01, 0.05]") == expected);
  const auto setup = read(folder.write("s.yaml", k_small)).setup;
  const auto& feed = setup.emitters[0].model;
  CHECK(std::get<std::vector<double>>(feed.values[4]) == std::vector<double>{3e-4, 5e-4});
}

TEST_CASE("what is disabled shall be checked but left out") {
  const Folder folder;
  CHECK(read(folder.write("s.yaml", k_small)).setup.bodies.empty());
  const auto enabled =
      read(folder.write("s.yaml", changed(k_small, "enabled: false", "enabled: true"))).setup;
  REQUIRE(enabled.bodies.size() == 1);
  const auto lines =
      problems(folder.write("s.yaml", changed(k_small, "length: 5 mm", "length: 5 deg")));
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].find("bodies.plate.length") != std::string::npos);
}

TEST_CASE("periodic sides shall have no air condition") {
  const Folder folder;
  const auto setup = read(folder.write("s.yaml", k_small)).setup;
  CHECK(setup.domain.sides[0].grains == scenario::GrainSide::periodic);
  CHECK_FALSE(setup.domain.sides[0].air);
  CHECK_FALSE(setup.domain.sides[1].air);
}

TEST_CASE("without a name, the scenario shall be named after its file") {
  const Folder folder;
  CHECK(read(folder.write("my belt.yaml", changed(k_small, "name: small\n", ""))).setup.name ==
        "my_belt");
}

TEST_CASE("fluid: none shall leave grains alone, with the air conditions still checked") {
  const Folder folder;
  const auto file = folder.write("s.yaml", k_small);
  const auto setup = read(file, {{"fluid", "none"}}).setup;
  CHECK_FALSE(setup.fluid);
  CHECK_FALSE(setup.drag);
  CHECK_FALSE(setup.voidage);
  for (const auto& side : setup.domain.sides) CHECK_FALSE(side.air);
  const auto lines =
      problems(folder.write("s.yaml", changed(k_small, "model: gidaspow", "model: gidaspov")),
               {{"fluid", "none"}});
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].find("gidaspow") != std::string::npos);
}

TEST_CASE("an included file shall lie under the including one, key by key") {
  const Folder folder;
  folder.write("base.yaml", k_small);
  const auto file = folder.write(
      "top.yaml",
      "include: base.yaml\nname: top\ntime: {end: 2 s}\nmaterials: {sand: {density: 3000}}\n");
  const auto setup = read(file).setup;
  CHECK(setup.name == "top");
  CHECK(setup.time.end == 2);
  CHECK(setup.time.fluid_step == 1e-3);
  CHECK(setup.materials[0].properties.density == 3000);
  CHECK(setup.materials[0].properties.young_modulus == 5e7);
}

TEST_CASE("a problem in an included file shall be told with that file's place") {
  const Folder folder;
  folder.write("base.yaml", changed(k_small, "density: 2650", "density: -1"));
  const auto lines = problems(folder.write("top.yaml", "include: [base.yaml]\nname: top\n"));
  REQUIRE(lines.size() == 1);
  CHECK(lines[0] == "base.yaml:15:19: error: materials.sand.density: -1 is outside rho > 0 kg/m3");
}

TEST_CASE("files that include each other in a circle shall be refused") {
  const Folder folder;
  folder.write("a.yaml", "include: b.yaml\n");
  const auto lines = problems(folder.write("b.yaml", k_small + "include: a.yaml\n"));
  REQUIRE_FALSE(lines.empty());
  CHECK(joined(lines).find("in a circle") != std::string::npos);
  CHECK(joined(lines).find("a.yaml:1:10: error: ") != std::string::npos);
  const auto missing = problems(folder.write("c.yaml", k_small + "include: not_there.yaml\n"));
  REQUIRE(missing.size() == 1);
  CHECK(missing[0].starts_with("c.yaml:42:10: error: include: "));
}

TEST_CASE("what an included file gives that cannot be read shall not be told to be missing") {
  const Folder folder;
  // All keys but the name stand in the file that is not there.
  for (const std::string include : {"not_there.yaml", "self.yaml", "[broken.yaml]"}) {
    CAPTURE(include);
    folder.write("broken.yaml", "time: {end: 1 s\n");
    const auto lines = problems(folder.write("self.yaml", "name: a\ninclude: " + include + "\n"));
    REQUIRE_MESSAGE(lines.size() == 1, joined(lines));
  }
}

TEST_CASE("aliases shall stand for what they name") {
  const Folder folder;
  auto text = changed(k_small, "air: {model: slip}", "air: &smooth {model: slip}");
  text = changed(text, "material: glass, air: {model: slip}", "material: glass, air: *smooth");
  CHECK(problems(folder.write("s.yaml", text)).empty());
}

TEST_CASE("a bare number that was hardly meant in SI shall draw a warning with both readings") {
  const auto warnings = [](const std::string& path, const std::string& value) {
    // Without a feed that a belt of 3 m would bury; that its surface is outside the domain then is
    // told besides.
    auto lines =
        read(transfer_point(), {{path, value}, {"emitters.feed.enabled", "false"}}).warnings;
    std::erase_if(lines, [](const std::string& line) {
      return line.find("has no unit") == std::string::npos;
    });
    return lines;
  };
  const auto before = warnings("emitters.feed.enabled", "false").size();
  const auto one = [&](const std::string& path, const std::string& value) {
    const auto lines = warnings(path, value);
    REQUIRE(lines.size() == before + 1);
    return lines.back();
  };
  // A thickness, a place and an angle.
  CHECK(one("bodies.belt.thickness", "3")
            .find("bodies.belt.thickness: 3 has no unit and is read as 3 m: write 3 mm or 3 m") !=
        std::string::npos);
  CHECK(one("frames.conveyor.origin", "[80, 0, 200]").find("200 has no unit and is read as") !=
        std::string::npos);
  CHECK(one("frames.conveyor.angle", "16").find("write 16 deg or 16 rad") != std::string::npos);
  // Said, or likely.
  CHECK(warnings("bodies.belt.thickness", "3 m").size() == before);
  CHECK(warnings("bodies.belt.thickness", "0.003").size() == before);
  CHECK(warnings("frames.conveyor.origin", "[0.08, 0, 0.2]").size() == before);
  CHECK(warnings("frames.conveyor.angle", "0.2").size() == before);
}

TEST_CASE("means that begin when the run has ended shall draw a warning where they are asked for") {
  const Folder folder;
  const auto warnings = [&](const std::string& text) {
    return joined(read(folder.write("s.yaml", text)).warnings);
  };
  const std::string drops = "drops: [5, 10 mm]";
  CHECK(warnings(changed(k_small, drops, drops + ", steady_after: 1 ms")).find("steady_after") ==
        std::string::npos);
  const std::string late = warnings(changed(k_small, drops, drops + ", steady_after: 8 s"));
  CHECK_MESSAGE(late.find("warning: sensors.stream.steady_after: 8 s is not before time.end, ") !=
                    std::string::npos,
                late);
  CHECK(late.find("s.yaml:41:") != std::string::npos);
  CHECK(warnings(k_small + "dust: {finer_than: 1 mm, steady_after: 8 s}\n")
            .find("warning: dust.steady_after: 8 s is not before time.end") != std::string::npos);
  const std::string off = "stream: {enabled: false, model: trajectory";
  CHECK(warnings(changed(changed(k_small, drops, drops + ", steady_after: 8 s"),
                         "stream: {model: trajectory", off))
            .find("steady_after") == std::string::npos);
}

TEST_CASE("a scenario that the engine wrote shall draw no warning of bare numbers") {
  const auto given = read(transfer_point(),
                          {{"bodies.belt.thickness", "3 m"}, {"emitters.feed.enabled", "false"}});
  const Folder folder;
  const auto written = folder.write("scenario.yaml", given.resolved_yaml);
  CHECK(read(written).warnings.size() == given.warnings.size());
  // A setting on top of it is a user's.
  CHECK(read(written, {{"bodies.belt.thickness", "3"}}).warnings.size() ==
        given.warnings.size() + 1);
}

TEST_CASE("an including file shall be able to exchange a model that has parameters") {
  const Folder folder;
  folder.write("base.yaml", changed(k_small, "air: {model: total_pressure}",
                                    "air: {model: total_pressure, pressure: 2 Pa}"));
  const std::string top =
      "include: base.yaml\ndomain:\n  boundaries:\n    top: {air: {model: no_slip";
  const auto setup = read(folder.write("top.yaml", top + "}}\n")).setup;
  CHECK(setup.domain.sides[5].air->name == "no_slip");
  // The same model takes what was given before, and what neither knows is told.
  const std::string same = changed(top, "no_slip", "total_pressure");
  const auto kept = read(folder.write("same.yaml", same + "}}\n")).setup;
  CHECK(std::get<double>(kept.domain.sides[5].air->values[0]) == 2.0);
  const auto lines = problems(folder.write("wrong.yaml", top + ", presure: 1 Pa}}\n"));
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].find("unknown key 'presure'") != std::string::npos);
}

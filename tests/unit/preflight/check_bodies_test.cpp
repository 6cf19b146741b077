// SPDX-License-Identifier: Apache-2.0
// What `engine check` says of meshes, gaps and flows.
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

using dust::test::approx;
using dust::test::engine;
using dust::test::read_file;
using dust::test::TemporaryFolder;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A domain of `size` m with a feed; two boxes 8 mm apart (lines 20 and 21) and one that touches.
fs::path write_scenario(const TemporaryFolder& folder, double size, const std::string& flow) {
  const fs::path file = folder / "gap.yaml";
  const std::string s = std::to_string(size);
  std::ofstream(file)
      << "name: gap\n"
         "time: {end: 10 ms, fluid_step: 1 ms, output_every: 10 ms}\n"
         "gravity: [0, 0, -9.81]\n"
         "domain:\n"
         "  min: [0, 0, 0]\n"
         "  max: ["
      << s << ", " << s << ", " << s
      << "]\n"
         "  boundaries:\n"
         "    left: {grains: open}\n"
         "    right: {grains: open}\n"
         "    front: {grains: open}\n"
         "    back: {grains: open}\n"
         "    bottom: {grains: open}\n"
         "    top: {grains: open}\n"
         "materials:\n"
         "  sand: {density: 2650, young_modulus: 5 MPa, poisson_ratio: 0.3}\n"
         "interactions:\n"
         "  - {between: [sand, sand], contact: {model: hertz_mindlin, restitution: 0.9, "
         "friction: 0.5}}\n"
         "bodies:\n"
         "  floor: {shape: box, material: sand, min: [0, 0, 0], max: [0.1, 0.1, "
         "0.01]}\n"
         "  step: {shape: box, material: sand, min: [0.02, 0.02, 0.018], max: "
         "[0.04, 0.04, 0.05]}\n"
         "  post: {shape: box, material: sand, min: [0.06, 0.02, 0.01], max: "
         "[0.08, 0.04, 0.05]}\n"
         "emitters:\n"
         "  feed: {model: feed, material: sand, mass_flow: "
      << flow
      << ", min: [0.01, 0.01, 0.09], max: [0.09, 0.09, 0.09], velocity: [0, 0, "
         "-1 m/s], diameters: [5, 12 mm], number_fractions: [0.5, 0.5]}\n"
         "fluid: none\n";
  return file;
}

Json numbers_of(const fs::path& file) {
  const auto outcome = engine({"check", file.string(), "--json"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  return Json::parse(outcome.out);
}

std::string text_of(const fs::path& file) {
  const auto outcome = engine({"check", file.string()});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  return outcome.out;
}

}  // namespace

TEST_CASE("a check shall name narrow gaps with both bodies, the place and the line") {
  const TemporaryFolder folder;
  const fs::path file = write_scenario(folder, 0.1, "1 g/s");
  const Json numbers = numbers_of(file);
  const Json& gaps = numbers["gaps"];
  // The post stands on the floor: no gap; post and step are 20 mm apart, more than a grain.
  REQUIRE(gaps.size() == 1);
  CHECK(gaps[0]["bodies"] == Json({"floor", "step"}));
  CHECK(gaps[0]["width_m"].get<double>() == approx(0.008).epsilon(1e-6));
  CHECK(gaps[0]["place_m"][0].get<double>() >= 0.02 - 1e-9);
  CHECK(gaps[0]["place_m"][0].get<double>() <= 0.04 + 1e-9);
  REQUIRE(numbers["touching"].size() == 1);
  CHECK(numbers["touching"][0]["bodies"] == Json({"floor", "post"}));
  const std::string text = text_of(file);
  CHECK(text.find("floor - step: 8 mm at") != std::string::npos);
  CHECK(text.find("0.67 of the largest grain; grains above 8 mm do not go through") !=
        std::string::npos);
  CHECK(text.find("gap.yaml:20:") != std::string::npos);
}

TEST_CASE("a body that crosses a running belt shall be warned of, with file and line") {
  const TemporaryFolder folder;
  const fs::path file = folder / "belt.yaml";
  std::ofstream(file)
      << "name: belt\n"
         "time: {end: 2 s, fluid_step: 5 ms, output_every: 1 s}\n"
         "gravity: [0, 0, -9.81]\n"
         "domain: {min: [0, 0, 0], max: [2, 0.5, 1 m], boundaries: {left: {grains: open}, right: "
         "{grains: open}, front: {grains: open}, back: {grains: open}, bottom: {grains: open}, "
         "top: {grains: open}}}\n"
         "materials:\n"
         "  coal: {density: 1400, young_modulus: 5 MPa, poisson_ratio: 0.3}\n"
         "interactions:\n"
         "  - {between: [coal, coal], contact: {model: hertz_mindlin, restitution: 0.3, friction: "
         "0.5}}\n"
         "bodies:\n"
         "  belt: {shape: conveyor, material: coal, head: [2.5, 0.25, 0.4 m], tail: [0.2, 0.25, "
         "0.4 m], radius: 100 mm, thickness: 10 mm, motion: belt, speed: 1.5 m/s}\n"
         "  skirt: {shape: box, material: coal, min: [0.5, 0, 0.45 m], max: [1.5, 0.02, 0.8 m]}\n"
         "  plate: {shape: box, material: coal, min: [0.5, 0.48, 0.6 m], max: [1.5, 0.5, 0.8 m]}\n"
         "emitters:\n"
         "  feed: {model: feed, material: coal, mass_flow: 1 kg/s, min: [0.3, 0.1, 0.6], max: "
         "[0.5, 0.4, 0.6], velocity: [1.5, 0, -1 m/s], diameters: [20 mm], mass_fractions: [1]}\n"
         "fluid: none\n"
         "sensors:\n"
         "  early: {model: kinetic_energy, steady_after: 0.2 s}\n"
         "  later: {model: kinetic_energy, steady_after: 1.3 s}\n";
  const auto said = [&](const std::string& key, const std::string& value) {
    const auto outcome = engine({"check", file.string(), "--set", key + "=" + value});
    REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
    return outcome.err;
  };
  const std::string crossing = said("name", "belt");
  INFO(crossing);
  CHECK(crossing.find("belt.yaml:11:3: warning: bodies.skirt: touches or crosses 'belt' at ") !=
        std::string::npos);
  CHECK(crossing.find("where that runs at 1.5 m/s") != std::string::npos);
  CHECK(crossing.find("a gap below 20 mm lets no grain through") != std::string::npos);
  CHECK(crossing.find("bodies.plate") == std::string::npos);
  CHECK(said("bodies.skirt.min", "[0.5, 0, 0.52 m]").find("crosses") == std::string::npos);
  CHECK(said("bodies.belt.speed", "0 m/s").find("crosses") == std::string::npos);
  // A fall of some 70 mm, then 1.6 m at 1.5 m/s.
  CHECK(crossing.find("sensors.early.steady_after: means begin at 0.2 s, before the stream has "
                      "come through the domain, at about 1") != std::string::npos);
  CHECK(crossing.find("sensors.later") == std::string::npos);
}

TEST_CASE("flows and extents shall be spoken of in the units of their size") {
  const TemporaryFolder folder;
  const std::string small = text_of(write_scenario(folder, 0.1, "1 g/s"));
  CHECK(small.find("domain     100 x 100 x 100 mm") != std::string::npos);
  CHECK(small.find("feed: sand, 1 g/s") != std::string::npos);
  const std::string plant = text_of(write_scenario(folder, 3.0, "18 t/h"));
  CHECK(plant.find("domain     3 x 3 x 3 m") != std::string::npos);
  CHECK(plant.find("feed: sand, 18 t/h (5 kg/s)") != std::string::npos);
  CHECK(plant.find("e+0") == std::string::npos);
}

TEST_CASE("a plant with meshes shall be checked within seconds, its sheets beside the cell") {
  const auto begin = std::chrono::steady_clock::now();
  const Json j = numbers_of(DUST_SOURCE "/scenarios/plant/transfer_open.yaml");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  // Generous: a second of search beside reading everything, on a machine that does other things.
  CHECK(took.count() < 15.0);
  REQUIRE(j["meshes"].size() == 2);
  for (const Json& mesh : j["meshes"]) {
    CHECK(mesh["thinnest_wall_m"].get<double>() == approx(0.012));
    CHECK(mesh["notes"][0].get<std::string>().find("open edges") != std::string::npos);
  }
}

TEST_CASE("a run shall refuse an opening that meets no fluid with the line of its suction") {
  const TemporaryFolder folder;
  const fs::path file = folder / "hood.yaml";
  // The cover moves: what it covers later only the run finds out.
  std::ofstream(file)
      << "name: hood\n"
         "time: {end: 2 ms, fluid_step: 1 ms, output_every: 2 ms}\n"
         "gravity: [0, 0, -9.81]\n"
         "domain:\n"
         "  min: [0, 0, 0]\n"
         "  max: [0.1, 0.1, 0.1]\n"
         "  boundaries:\n"
         "    left: {grains: open, air: {model: total_pressure}}\n"
         "    right: {grains: open, air: {model: total_pressure}}\n"
         "    front: {grains: open, air: {model: total_pressure}}\n"
         "    back: {grains: open, air: {model: total_pressure}}\n"
         "    bottom: {grains: open, air: {model: total_pressure}}\n"
         "    top: {grains: open, air: {model: total_pressure}}\n"
         "materials:\n"
         "  steel: {density: 7800, young_modulus: 50 MPa, poisson_ratio: 0.3}\n"
         "bodies:\n"
         "  hood: {shape: box, material: steel, min: [0.03, 0.03, 0.06], max: [0.07, 0.07, 0.08],\n"
         "    suction: {flow: -60 l/min, min: [0.04, 0.04, 0.06], max: [0.06, 0.06, 0.06]}}\n"
         "  cover: {shape: box, material: steel, min: [0.03, 0.03, 0.03], max: [0.07, 0.07, "
         "0.06],\n"
         "    motion: translate, velocity: [0, 0, -1 mm/s]}\n"
         "fluid: {cells: [10, 10, 10], density: 1.2, viscosity: 18 uPa s}\n";
  CHECK(text_of(file).find("hood: box of steel, at rest, blows 3.6 m3/h") != std::string::npos);
  const auto outcome = engine({"run", file.string(), "-o", (folder / "out").string(), "--quiet"});
  CHECK(outcome.status == 2);
  CHECK(outcome.err.find("hood.yaml:18:5: error: bodies.hood.suction: no part of the body's "
                         "surface between min and max meets the fluid") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("a drawing of the set-up shall have both ends of what reaches from one to the other") {
  const TemporaryFolder folder;
  const auto file = write_scenario(folder, 0.1, "1 g/s");
  const fs::path page = folder / "setup.html";
  const auto outcome = engine(
      {"check", file, "-o", page, "--set",
       "emitters.bed={model: fill, material: sand, region: cylinder, from: [50, 70, 10 mm], to: "
       "[50, 70, 60 mm], radius: 10 mm, end_radius: 20 mm, count: 10, diameters: [1 mm], "
       "mass_fractions: [1]}",
       "--set", "sensors.drop={model: pressure_drop, from: [10, 50, 10 mm], to: [10, 50, 90 mm]}"});
  REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
  const std::string text = read_file(page);
  const std::string head = "id=\"run-data\">";
  const auto at = text.find(head) + head.size();
  const auto setting = Json::parse(text.substr(at, text.find("</script>", at) - at))["setting"];
  const auto& bed = setting["emitters"][1];
  REQUIRE(bed["name"] == "bed");
  CHECK(bed["min"][0].get<double>() == approx(0.03));
  CHECK(bed["min"][2].get<double>() == approx(0.01));
  CHECK(bed["max"][1].get<double>() == approx(0.09));
  CHECK(bed["max"][2].get<double>() == approx(0.06));
  const auto& drop = setting["sensors"][0];
  CHECK(drop["at"][2].get<double>() == approx(0.01));
  CHECK(drop["to"][0].get<double>() == approx(0.01));
  CHECK(drop["to"][2].get<double>() == approx(0.09));
}

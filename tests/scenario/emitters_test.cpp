// SPDX-License-Identifier: Apache-2.0
// Emitters through the whole program: what is asked for, what comes, and what is refused.
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using dust::test::engine;
using dust::test::json_text;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_head = R"(
time: {end: 4 ms, fluid_step: 1 ms, output_every: 2 ms}
gravity: [0, 0, -9.81]
domain:
  min: [0, 0, 0]
  max: [10, 10, 20 mm]
  boundaries:
    left: {grains: periodic}
    right: {grains: periodic}
    front: {grains: wall, material: glass}
    back: {grains: wall, material: glass}
    bottom: {grains: wall, material: glass}
    top: {grains: open}
materials:
  glass: {density: 2500, young_modulus: 50 MPa, poisson_ratio: 0.3}
  dust: {density: 1500, young_modulus: 50 MPa, poisson_ratio: 0.3}
interactions:
  - {between: [glass, glass], contact: {model: hertz_mindlin, restitution: 0.9, friction: 0.4}}
  - {between: [glass, dust], contact: {model: hertz_mindlin, restitution: 0.9, friction: 0.4}}
  - {between: [dust, dust], contact: {model: hertz_mindlin, restitution: 0.9, friction: 0.4}}
fluid: none
emitters:
)";

fs::path write(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  const fs::path file = folder / name;
  std::ofstream(file) << text;
  return file;
}

/// Runs and expects refusal with exit status 2 and nothing written, of a check in the same words.
std::string refusal(const TemporaryFolder& folder, const std::string& emitters) {
  const fs::path out = folder / "refused";
  const fs::path file = write(folder, "bad.yaml", k_head + emitters);
  const auto run = engine({"run", file, "-o", out, "--quiet"});
  CHECK(run.status == 2);
  CHECK_FALSE(fs::exists(out));
  const auto check = engine({"check", file});
  CHECK(check.status == 2);
  CHECK(check.err == run.err);
  CHECK(check.out.empty());
  return run.err;
}

}  // namespace

TEST_CASE(
    "grains that are there before the first step shall be in the first frame and the summary") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const auto scenario = write(folder, "s.yaml", k_head + R"(
  bed: {model: fill, material: glass, min: [0, 0, 0], max: [10, 10, 8 mm], mass: 0.5 g, diameters: [0.8, 1 mm], mass_fractions: [1, 1]}
  late: {model: single, material: glass, time: 2.5 ms, positions: [[5, 5, 15 mm]], diameters: [1 mm]}
  gas: {model: lattice, material: dust, min: [0, 0, 10 mm], max: [10, 10, 13 mm], spacing: 1 mm, count: 50, diameters: [0.5 mm]}
sensors:
  energy: {model: kinetic_energy}
  contacts: {model: coordination}
  pressure: {model: stress, min: [0, 0, 0], max: [10, 10, 20 mm], cells: [1, 1, 4]}
)");
  const auto run = engine({"run", scenario, "-o", out, "--quiet"});
  INFO(run.err);
  REQUIRE(run.status == 0);
  const std::string summary = read_file(out / "summary.json");
  CHECK(summary.find("\"achieved_mass_fraction\"") != std::string::npos);
  CHECK(json_text(out / "summary.json", "count") == "null");  // of bed, asked for by mass
  // 0.5 g, half by mass of each size: 373 + 191 grains, 50 of dust, one late.
  const auto emitted = std::stoll(json_text(out / "summary.json", "emitted"));
  CHECK(emitted >= 373 + 191 + 50);
  CHECK(emitted <= 373 + 191 + 53);
  CHECK(read_file(out / "report.json").find("Sizes released") != std::string::npos);
  const std::string row = read_file(out / "series.csv");
  const auto line = row.substr(row.find('\n') + 1);
  CHECK(line.find("\n") != std::string::npos);
  CHECK(line.substr(0, line.find('\n')).find("," + std::to_string(emitted - 1) + ",") !=
        std::string::npos);

  // Its last frame starts another run, with both materials.
  const fs::path again = folder / "again";
  const auto second = write(folder, "again.yaml", k_head + R"(
  bed: {model: file, material: glass, materials: [dust], file: out/results.h5, allowed_overlap: 0.02}
)");
  const auto rerun = engine({"run", second, "-o", again, "--quiet"});
  INFO(rerun.err);
  REQUIRE(rerun.status == 0);
  CHECK(json_text(again / "summary.json", "emitted") == std::to_string(emitted));
}

TEST_CASE("a resumed run shall not let in again what was there at the start") {
  const TemporaryFolder folder;
  const std::string bed = R"(
  bed: {model: fill, material: glass, min: [0, 0, 0], max: [10, 10, 8 mm], count: 200, diameters: [1 mm]}
)";
  const auto scenario = write(folder, "s.yaml", k_head + bed);
  const std::vector<std::string> longer{"--quiet", "--set", "time.end=60 ms"};
  const auto command = [&](const fs::path& out, std::vector<std::string> more = {}) {
    std::vector<std::string> all{"run", scenario, "-o", out};
    all.insert(all.end(), longer.begin(), longer.end());
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const fs::path whole = folder / "whole";
  REQUIRE(engine(command(whole)).status == 0);
  const fs::path part = folder / "part";
  REQUIRE(dust::test::engine_interrupted(command(part), SIGINT, part / "series.csv", 4).status ==
          130);
  CHECK(json_text(part / "summary.json", "status") == "interrupted");
  const auto resumed = engine(command(part, {"--resume"}));
  INFO(resumed.err);
  REQUIRE(resumed.status == 0);
  CHECK(json_text(part / "summary.json", "emitted") == "200");
  CHECK(json_text(part / "summary.json", "computed") == "200");
  CHECK(json_text(part / "summary.json", "state_sha256") ==
        json_text(whole / "summary.json", "state_sha256"));
}

TEST_CASE("overlapping starts shall be refused with both grains, lines and places") {
  const TemporaryFolder folder;
  write(folder, "bed.csv", "diameter,x,y,z\n1e-3,5e-3,5e-3,5e-3\n1e-3,5e-3,5e-3,5.9e-3\n");
  const auto text = refusal(folder, "  bed: {model: file, material: glass, file: bed.csv}\n");
  CHECK(text.find("bad.yaml:23:16: error: emitters.bed: a grain of 0.001 m at (0.005, 0.005, "
                  "0.0059) m (line 3) and a grain of 0.001 m at (0.005, 0.005, 0.005) m (line 2) "
                  "overlap by 0.0001 m, 0.2 of the smaller radius; 0.005 is allowed: move one of "
                  "them, or allow more (allowed_overlap)") != std::string::npos);
  const auto across = refusal(folder,
                              "  bed: {model: single, material: glass, positions: [[0.2, 5, "
                              "5 mm], [9.7, 5, 5 mm]], diameters: [1 mm]}\n");
  CHECK(across.find("overlap by 0.0005 m") != std::string::npos);
  CHECK(across.find("0 is allowed: move one of them; grains that touch at the start, as in a "
                    "settled bed, come from a file (model: file, whose allowed_overlap takes "
                    "them)") != std::string::npos);
  const auto wall = refusal(
      folder,
      "  bed: {model: single, material: glass, positions: [[5, 5, 0.4 mm]], diameters: [1 mm]}\n");
  CHECK(wall.find("overlaps 'bottom' by 0.0001 m; move it clear") != std::string::npos);
  const auto outside = refusal(
      folder,
      "  bed: {model: single, material: glass, positions: [[5, 5, 30 mm]], diameters: [1 mm]}\n");
  CHECK(outside.find("lies outside the domain") != std::string::npos);
}

TEST_CASE(
    "grains in a body shall be refused by a check, too, those of later with it as it is then") {
  const TemporaryFolder folder;
  const std::string block =
      "bodies: {block: {shape: box, material: glass, min: [2, 2, 5 mm], max: [8, 8, 9 mm]}}\n";
  const auto grain = [&](const std::string& more) {
    return "  grain: {model: single, material: glass, positions: [[5, 5, 7 mm]], "
           "diameters: [1 mm]" +
           more + "}\n" + block;
  };
  CHECK(refusal(folder, grain("")).find("overlaps 'block' by") != std::string::npos);
  const auto check = [&](const std::string& text, const std::string& set = "name=s") {
    return engine({"check", write(folder, "late.yaml", k_head + text), "--set", set});
  };
  const auto late = check(grain(", time: 2 ms"));
  CHECK(late.status == 2);
  CHECK(late.err.find("overlaps 'block' by") != std::string::npos);
  CHECK(check(grain(", time: 2 ms"), "bodies.block.remove.at=1 ms").status == 0);
  CHECK(check(grain(", time: 2 ms"), "bodies.block.remove.at=3 ms").status == 2);
  // A filling that would have to share its region with the block.
  const auto filled = refusal(
      folder,
      "  bed: {model: fill, material: glass, min: [1, 1, 4 mm], max: [9, 9, 10 mm], mass: 0.25 g, "
      "diameters: [1 mm]}\n" +
          block);
  CHECK(filled.find("error: emitters.bed: only ") != std::string::npos);
}

TEST_CASE("a filling that does not fit shall be refused, when read or before the first step") {
  const TemporaryFolder folder;
  const auto dense = refusal(folder,
                             "  bed: {model: fill, material: glass, min: [0, 0, 0], max: "
                             "[10, 10, 2 mm], mass: 1 g, diameters: [1 mm]}\n");
  CHECK(dense.find("bad.yaml:23:16: error: emitters.bed: the region cannot hold the grains") !=
        std::string::npos);
  // Equal spheres at random places run out of room at a solids fraction of 0.38.
  const std::string tight =
      "  bed: {model: fill, material: glass, min: [0, 0, 0], max: [10, 10, 5 mm], mass: 0.5 g, "
      "diameters: [1 mm]}\n";
  const auto late = refusal(folder, tight);
  CHECK(late.find("bad.yaml:23:16: error: emitters.bed: only ") != std::string::npos);
  // What another emitter has put there first takes the room.
  const auto taken = refusal(folder, R"(
  first: {model: fill, material: glass, min: [0, 0, 0], max: [10, 10, 8 mm], mass: 0.6 g, diameters: [1 mm]}
  second: {model: fill, material: glass, min: [0, 0, 0], max: [10, 10, 8 mm], mass: 0.3 g, diameters: [1 mm]}
)");
  CHECK(taken.find("error: emitters.second: only ") != std::string::npos);
}

TEST_CASE("wrong lists, files and periodic widths shall be told with their places") {
  const TemporaryFolder folder;
  CHECK(refusal(folder, "  bed: {model: file, material: glass, file: nowhere.csv}\n")
            .find("bad.yaml:23:45: error: emitters.bed.file: there is no file " +
                  (folder / "nowhere.csv").string()) != std::string::npos);
  write(folder, "rows.csv", "diameter,x,y,z\n1e-3,1,2\n");
  CHECK(refusal(folder, "  bed: {model: file, material: glass, file: rows.csv}\n")
            .find("error: emitters.bed: rows.csv:2: 3 values for 4 columns") != std::string::npos);
  CHECK(refusal(folder,
                "  bed: {model: single, material: glass, positions: [[5, 5 mm]], "
                "diameters: [1 mm]}\n")
            .find("emitters.bed.positions: a vector [x, y, z] is expected, not a list of 2") !=
        std::string::npos);
  CHECK(
      refusal(folder, "  bed: {model: single, material: glass, positions: 5, diameters: [1 mm]}\n")
          .find("emitters.bed.positions: a list of vectors [[x, y, z], ...] is expected") !=
      std::string::npos);
  CHECK(refusal(folder,
                "  bed: {model: single, material: glass, positions: [[5, 5, 5 mm]], "
                "diameters: [4 mm]}\n")
            .find("error: domain: 0.01 m between the periodic sides left and right are less than 3 "
                  "diameters of the largest grain, 0.004 m") != std::string::npos);
  // Three diameters but for rounding are enough: what is refused is the place.
  CHECK(refusal(folder,
                "  bed: {model: single, material: glass, positions: [[5, 5, 30 mm]], "
                "diameters: [3.33333333334 mm]}\n")
            .find("lies outside the domain") != std::string::npos);
}

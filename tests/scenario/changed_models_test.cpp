// SPDX-License-Identifier: Apache-2.0
#include "support/engine.hpp"

#include <doctest/doctest.h>

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

/// Grains that lie on a floor, by a law of which there are several versions.
const char* const k_heap = R"(name: heap
time: {end: 60 ms, fluid_step: 1 ms, output_every: 20 ms}
gravity: [0, 0, -9.81]
domain:
  min: [0, 0, 0]
  max: [10, 10, 20 mm]
  boundaries:
    left: {grains: wall, material: sand}
    right: {grains: wall, material: sand}
    front: {grains: wall, material: sand}
    back: {grains: wall, material: sand}
    bottom: {grains: wall, material: sand}
    top: {grains: open}
materials:
  sand: {density: 2500, young_modulus: 1 MPa, poisson_ratio: 0.3}
interactions:
  - between: [sand, sand]
    contact: {model: changing_law, stiffness: 200 N/m}
    rolling: {model: epsd2, friction: 0.2}
emitters:
  drop: {model: feed, material: sand, mass_flow: 5 g/s, diameters: [1 mm], number_fractions: [1],
    min: [1, 1, 4 mm], max: [9, 9, 4 mm], velocity: [0, 0, -0.1 m/s]}
fluid: none
sensors:
  energy: {model: kinetic_energy}
)";

fs::path write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file;
}

/// The engine with the plugin of one version.
dust::test::Outcome with(const std::string& law, std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--plugin-path", std::string(DUST_CHANGING_LAWS) + "/" + law});
  return engine(arguments);
}

bool says(const std::string& text, const std::string& words) {
  INFO(text);
  CHECK(text.find(words) != std::string::npos);
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a run shall not be resumed with another version of its plugins") {
  const TemporaryFolder folder;
  const std::string heap = write(folder / "heap.yaml", k_heap);
  const std::string out = folder / "out";
  REQUIRE(with("first", {"run", heap, "-o", out, "--set", "time.end=40 ms", "--quiet"}).status ==
          0);
  for (const std::string law : {"second", "longer"}) {
    CAPTURE(law);
    const auto refused = with(law, {"run", heap, "-o", out, "--resume", "--quiet"});
    CHECK(refused.status == 2);
    says(refused.err, "contact/changing_law was of version 1.0");
    says(refused.err, law == "second" ? "and is of version 2.0 here"
                                      : "with 1 number per contact, and is of version 1.0 with 2 "
                                        "numbers per contact here");
    says(refused.err,
         "go on with the plugin of version 1.0 (--plugin-path), start again with "
         "--force");
  }
  CHECK(with("first", {"run", heap, "-o", out, "--resume", "--quiet"}).status == 0);
  REQUIRE(with("first", {"run", heap, "-o", folder / "whole", "--quiet"}).status == 0);
  CHECK(json_text(fs::path(out) / "summary.json", "state_sha256") ==
        json_text(folder / "whole" / "summary.json", "state_sha256"));
}

TEST_CASE("a branch with another version of a law shall begin its contacts anew and say so") {
  const TemporaryFolder folder;
  const std::string heap = write(folder / "heap.yaml", k_heap);
  REQUIRE(with("first", {"run", heap, "-o", folder / "half", "--quiet"}).status == 0);
  const std::string from = "start_from=" + (folder / "half").string();
  const std::vector<std::string> set = {"--set", from, "--set", "time.end=80 ms"};
  for (const std::string law : {"first", "second", "longer"}) {
    CAPTURE(law);
    std::vector<std::string> check = {"check", heap};
    check.insert(check.end(), set.begin(), set.end());
    const auto checked = with(law, check);
    CHECK(checked.status == 0);
    CHECK((checked.out.find("unbroken run") != std::string::npos) == (law == "first"));
    std::vector<std::string> run = {"run", heap, "-o", folder / law, "--quiet"};
    run.insert(run.end(), set.begin(), set.end());
    const auto done = with(law, run);
    INFO(done.err);
    CHECK(done.status == 0);
    const bool is_warned = done.err.find("contacts begin anew") != std::string::npos;
    CHECK(is_warned == (law != "first"));
    if (law != "first") says(done.err, "contact/changing_law was of version 1.0");
  }
}

TEST_CASE("a study shall not mix versions of a plugin in one table") {
  const TemporaryFolder folder;
  write(folder / "heap.yaml", k_heap);
  const std::string text =
      "base: heap.yaml\nmeasure: {grains: particles.emitted}\nset: {time.end: 10 ms}\n"
      "vary: {'interactions[0].contact.stiffness': ";
  const std::string study = write(folder / "study.yaml", text + "[100, 200 N/m]}\n");
  const std::string out = folder / "out";
  REQUIRE(with("first", {"study", study, "-o", out, "--quiet"}).status == 0);
  write(folder / "study.yaml", text + "[100, 200, 300 N/m]}\n");
  const auto refused = with("second", {"study", study, "-o", out, "--resume", "--quiet"});
  CHECK(refused.status == 2);
  says(refused.err,
       "2 points were run with contact/changing_law of version 1.0, which is 2.0 here");
  says(refused.err, "--force");
  CHECK(with("first", {"study", study, "-o", out, "--resume", "--quiet"}).status == 0);
}

TEST_CASE("a library built anew under the same version shall be gone on with and told of") {
  const TemporaryFolder folder;
  const std::string heap = write(folder / "heap.yaml", k_heap);
  const fs::path out = folder / "out";
  REQUIRE(with("first", {"run", heap, "-o", out, "--set", "time.end=20 ms", "--quiet"}).status ==
          0);
  const std::string warning = "contact/changing_law of version 1.0 is another library than before";
  const auto resume = [&](const std::string& law, const std::string& end) {
    const auto run =
        with(law, {"run", heap, "-o", out, "--set", "time.end=" + end, "--resume", "--quiet"});
    INFO(run.err);
    REQUIRE(run.status == 0);
    return read_file(out / "summary.json").find(warning) != std::string::npos;
  };
  CHECK_FALSE(resume("first", "30 ms"));
  CHECK(resume("rebuilt", "40 ms"));
  says(read_file(out / "run.log"), warning);
  // What has been mixed stays so.
  CHECK(resume("rebuilt", "50 ms"));

  const std::string study =
      write(folder / "study.yaml",
            "base: heap.yaml\nmeasure: {grains: particles.emitted}\nset: {time.end: 5 ms}\n"
            "vary: {'interactions[0].contact.stiffness': [100, 200 N/m]}\n");
  const std::string points = folder / "points";
  REQUIRE(with("first", {"study", study, "-o", points, "--quiet"}).status == 0);
  const auto same = with("first", {"study", study, "-o", points, "--resume", "--quiet"});
  CHECK(same.err.find("another library") == std::string::npos);
  const auto mixed = with("rebuilt", {"study", study, "-o", points, "--resume", "--quiet"});
  CHECK(mixed.status == 0);
  says(mixed.err, "2 points were run with another library of contact/changing_law 1.0 than ");
}

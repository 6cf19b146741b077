// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/engine.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

using dust::test::approx;
using dust::test::engine;
using dust::test::holds;
using dust::test::json_text;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_scenario = DUST_SOURCE "/tests/scenario/resolved_sphere.yaml";

/// What `engine check` says of the scenario with a change.
std::string checked(const std::vector<std::string>& settings, int status) {
  std::vector<std::string> arguments{"check", k_scenario};
  for (const std::string& setting : settings) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  const auto done = engine(arguments);
  INFO(done.err);
  CHECK(done.status == status);
  return done.out + done.err;
}

}  // namespace

TEST_CASE(
    "a resolved sphere beside grains shall give the same bits on any threads and after a resume") {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& name, const std::string& end, const std::string& threads,
                       std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"run",         k_scenario, "-o",
                                       folder / name, "--set",    "time.end=" + end,
                                       "--threads",   threads,    "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto done = engine(arguments);
    INFO(done.err);
    REQUIRE(done.status == 0);
    return json_text(folder / name / "summary.json", "state_sha256");
  };
  const auto whole = run("whole", "10 ms", "1");
  CHECK(run("threads", "10 ms", "2") == whole);
  run("parts", "6 ms", "2");
  CHECK(run("parts", "10 ms", "2", {"--resume"}) == whole);
  CHECK(json_text(folder / "whole" / "summary.json", "resolved_spheres") == "1");
  CHECK(std::stod(json_text(folder / "whole" / "summary.json", "resolved_least_cells_across")) ==
        approx(8.4));
  // The drag law's grains did not count it in.
  CHECK(std::stod(json_text(folder / "whole" / "summary.json", "smallest_void_fraction")) > 0.9);
}

TEST_CASE("engine check shall tell of resolved spheres how many cells and markers they have") {
  const std::string output = checked({}, 0);
  CHECK_MESSAGE(holds(output, "sphere: spheres of 8.4 mm are 8.4 cells across, 90 markers each"),
                output);
  // The grains beside it, of 1 mm and less, are what feels its own flow.
  CHECK_MESSAGE(!holds(output, "own disturbance felt by grains of 8.4 mm"), output);
}

TEST_CASE("engine check shall refuse spheres that the grid does not resolve, and say what would") {
  const std::string coarse = checked({"fluid.cells=[24, 24, 24]"}, 2);
  CHECK_MESSAGE(holds(coarse, "resolved_sphere.yaml:40:"), coarse);
  CHECK_MESSAGE(holds(coarse, "7.75 cells across, and 8 are the fewest: cells of at most 1.05 mm"),
                coarse);
  const std::string dry = checked({"fluid=none"}, 2);
  CHECK_MESSAGE(holds(dry, "resolved by the grid of a fluid, and fluid is none"), dry);
  CHECK_MESSAGE(holds(dry, "resolved_sphere.yaml:40:"), dry);
  const std::string late = checked({"coupling.overlap=true"}, 2);
  CHECK_MESSAGE(holds(late, "does not go with coupling.overlap"), late);
  const std::string light = checked({"materials.nylon.density=500"}, 2);
  CHECK_MESSAGE(holds(light, "0.5 of the fluid's density"), light);
}

TEST_CASE("engine check shall warn of flat cells round a resolved sphere") {
  const std::string flat =
      checked({"fluid.cells=[26, 26, 39]", "emitters.grains.diameters=[0.3 mm]"}, 0);
  CHECK_MESSAGE(holds(flat, "resolved_sphere.yaml:40:"), flat);
  CHECK_MESSAGE(holds(flat, "warning: coupling.resolved: cells are 1.5 times as long"), flat);
  CHECK_FALSE(holds(checked({"fluid.cells=[26, 26, 30]"}, 0), "times as long as wide"));
}

TEST_CASE("engine check shall refuse a fluid step that is too long for a resolved sphere's film") {
  // Cells of 1 mm, steps of 1 ms, 1000 kg/m3: 1 per Pa s.
  CHECK_FALSE(holds(checked({"fluid.viscosity=1 Pa s"}, 0), "fluid_step / (density"));
  const std::string refused = checked({"fluid.viscosity=1.2 Pa s"}, 2);
  CHECK_MESSAGE(holds(refused, "resolved_sphere.yaml:40:"), refused);
  CHECK_MESSAGE(holds(refused, "is 1.2; above 1 a sphere beside a wall and the fluid"), refused);
  CHECK_MESSAGE(holds(refused, "a time.fluid_step of at most 0.833 ms"), refused);
}

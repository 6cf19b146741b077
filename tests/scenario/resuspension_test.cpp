// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/run_summary.hpp"
#include "support/same_bits.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using dust::test::approx;
using dust::test::check_same_bits;
using dust::test::TemporaryFolder;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string k_shear = DUST_SOURCE "/tests/scenario/dust_under_shear.yaml";
const std::vector<std::string> k_plate{
    "--set", "bodies.plate={shape: box, material: steel, min: [0, 0, 0], max: [4, 4, 3.5 mm]}"};

json run(const fs::path& out, const std::vector<std::string>& more) {
  const json summary = dust::test::run_summary(k_shear, out, more);
  CHECK(std::abs(summary["dust_field"]["classes"]["20_um"]["balance_error"].get<double>()) < 1e-12);
  return summary;
}

double resuspended(const json& summary) {
  return summary["dust_field"]["classes"]["20_um"]["resuspended_kg"].get<double>();
}

/// Between 0.2 and 0.4 s, when the flow is steady.
double taken_off(const fs::path& folder, std::vector<std::string> more) {
  const double before = resuspended(run(folder / "before", more));
  more.insert(more.end(), {"--set", "time.end=0.4 s"});
  return resuspended(run(folder / "after", more)) - before;
}

/// Off 16 mm2 in 0.2 s under a gap [m] sheared at 1 m/s: eq. (14), (15) of docs/theory/dust.md.
double expected(double gap) {
  const double u2 = 0.01 / 1.2 * 1.0 / gap;
  const double threshold2 = 0.0123 * (2650.0 / 1.2 * 9.81 * 20e-6 + 3e-4 / (1.2 * 20e-6));
  return 1e-3 * 1.2 / 9.81 * std::pow(u2, 1.5) * (1.0 - threshold2 / u2) * 16e-6 * 0.2;
}

}  // namespace

TEST_CASE("a sheared gas shall take dust off a side as its friction velocity asks for") {
  const TemporaryFolder folder;
  CHECK(taken_off(folder / "side", {}) == approx(expected(20e-3)).epsilon(1e-3));
}

TEST_CASE("a sheared gas shall take dust off a body that cuts the cells") {
  const TemporaryFolder folder;
  CHECK(taken_off(folder / "body", k_plate) == approx(expected(16.5e-3)).epsilon(5e-3));
}

/// Still above; the plate's surface gets going after the walls have been found.
const std::vector<std::string> k_belt{"--set",
                                      "bodies.plate={shape: box, material: steel, min: [-40, -40, "
                                      "-40], max: [44, 44, 3.5 mm], motion: belt, "
                                      "speed: 1 m/s, start: 10 ms, ramp: 40 ms}",
                                      "--set", "domain.boundaries.top.air.velocity=[0, 0, 0 m/s]"};

TEST_CASE("a surface that speeds up shall shed dust by its speed of that moment") {
  const TemporaryFolder folder;
  CHECK(taken_off(folder / "belt", k_belt) == approx(expected(16.5e-3)).epsilon(5e-3));
}

TEST_CASE("a surface that speeds up shall shed the same dust after a resume") {
  const TemporaryFolder folder;
  const auto with = [](std::vector<std::string> more) {
    more.insert(more.end(), k_belt.begin(), k_belt.end());
    return more;
  };
  const json whole = run(folder / "whole", with({"--set", "time.end=0.1 s"}));
  run(folder / "parts", with({"--set", "time.end=0.05 s"}));
  const json resumed = run(folder / "parts", with({"--set", "time.end=0.1 s", "--resume"}));
  CHECK(resuspended(whole) > 0.0);
  CHECK(resumed["state_sha256"] == whole["state_sha256"]);
  CHECK(resumed["dust_field"] == whole["dust_field"]);
}

TEST_CASE("a shear below the threshold shall leave what has settled") {
  const TemporaryFolder folder;
  // 0.35 m/s where 0.4 m/s are needed.
  const json summary =
      run(folder / "out", {"--set", "domain.boundaries.top.air.velocity=[0.3, 0, 0 m/s]"});
  CHECK(resuspended(summary) == 0.0);
  CHECK(summary["dust_field"]["classes"]["20_um"]["deposited_kg"]["bottom"].get<double>() > 0.0);
}

TEST_CASE("what the gas takes off shall be the same on any threads and after a resume") {
  auto arguments = k_plate;
  arguments.insert(arguments.end(), {"--set", "dust.field.deposition=lai_nazaroff"});
  CHECK(resuspended(check_same_bits(k_shear, arguments, {"0.1 s", "0.2 s"}, {"dust_field"})) > 0.0);
}

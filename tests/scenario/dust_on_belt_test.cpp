// SPDX-License-Identifier: Apache-2.0
// Dust that has settled on a belt goes with it.
#include "support/approx.hpp"
#include "support/run_summary.hpp"
#include "support/same_bits.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

using dust::test::approx;
using dust::test::check_same_bits;
using dust::test::TemporaryFolder;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string k_belt = DUST_SOURCE "/tests/scenario/dust_on_belt.yaml";
/// The belt runs out of the domain at x = 0.4 m.
const std::vector<std::string> k_out{
    "--set", "domain.max=[400, 100, 300 mm]",
    "--set", "fluid.cells=[40, 4, 30]",
    "--set", "domain.boundaries.right={grains: open, air: {model: total_pressure}}"};

json run(const fs::path& out, std::vector<std::string> more, const std::string& end) {
  more.insert(more.end(), {"--set", "time.end=" + end, "--set", "dust.field.inertia=false"});
  return dust::test::run_summary(k_belt, out, more);
}

const json& dust_of(const json& summary) { return summary["dust_field"]["classes"]["60_um"]; }

double on_belt(const json& summary) { return dust_of(summary)["deposited_kg"].value("belt", 0.0); }

double carried_out(const json& summary) {
  return dust_of(summary)["carried_out_kg"].value("belt", 0.0);
}

}  // namespace

TEST_CASE("dust that lies on a belt shall stay on it all the way round") {
  const TemporaryFolder folder;
  const json summary = run(folder / "round", {}, "1.5 s");
  CHECK(std::abs(dust_of(summary)["balance_error"].get<double>()) < 1e-12);
  CHECK(on_belt(summary) == approx(2e-7).epsilon(1e-9));
  CHECK(carried_out(summary) == 0.0);
}

TEST_CASE("dust that a belt takes out of the domain shall be counted when it gets there") {
  const TemporaryFolder folder;
  // It settles within 0.2 s, by then 0.31 m along in its middle, and has 0.09 m to go at 0.4 m/s;
  // it is 0.1 m long. A twentieth is what the wide belt and the gas that it takes along smear.
  const json half = run(folder / "half", k_out, "0.425 s");
  CHECK(carried_out(half) == approx(1e-7).epsilon(0.1));
  CHECK(on_belt(half) + carried_out(half) == approx(2e-7).epsilon(1e-3));
  CHECK(std::abs(dust_of(half)["balance_error"].get<double>()) < 1e-12);
  const json whole = run(folder / "whole", k_out, "0.9 s");
  CHECK(carried_out(whole) > 0.99 * 2e-7);
  CHECK(std::abs(dust_of(whole)["balance_error"].get<double>()) < 1e-12);
}

TEST_CASE("dust on an arm that turns before it reaches a side shall not leave the domain") {
  const TemporaryFolder folder;
  // Its ends pass bottom and top 4 mm before them, in the same cells of 10 mm.
  const json summary =
      run(folder / "arm",
          {"--set",
           "bodies={arm: {shape: box, material: steel, min: [154, -10, 140 mm], max: [446, 110, "
           "160 mm], motion: rotate, pivot: [300, 50, 150 mm], spin_axis: [0, 1, 0], spin: 3}}"},
          "1 s");
  CHECK(dust_of(summary)["carried_out_kg"].value("arm", 0.0) == 0.0);
  CHECK(dust_of(summary)["deposited_kg"]["arm"].get<double>() > 1e-7);
  CHECK(std::abs(dust_of(summary)["balance_error"].get<double>()) < 1e-12);
}

TEST_CASE("a belt that stands shall keep where it fell what settles on it") {
  const TemporaryFolder folder;
  auto still = k_out;
  still.insert(still.end(), {"--set", "bodies.belt.speed=0 m/s"});
  const json summary = run(folder / "still", still, "0.9 s");
  CHECK(carried_out(summary) == 0.0);
  CHECK(on_belt(summary) > 0.99 * 2e-7);
}

TEST_CASE(
    "dust on a belt shall be the same on any threads, after a resume and in another scenario") {
  auto arguments = k_out;
  arguments.insert(arguments.end(), {"--set", "dust.field.inertia=false"});
  const json whole = check_same_bits(k_belt, arguments, {"0.25 s", "0.5 s"}, {"dust_field"});
  CHECK(carried_out(whole) > 0.0);

  // A body before the belt in the order of names: what lies keeps its surface.
  const TemporaryFolder folder;
  run(folder / "first", k_out, "0.25 s");
  std::ofstream(folder / "more.yaml") << "include: " << k_belt << "\nstart_from: first\n";
  arguments.insert(
      arguments.end(),
      {"--set", "bodies.a_box={shape: box, material: steel, min: [0, 0, 0], max: [20, 20, 20 mm]}",
       "--set", "time.end=0.5 s"});
  const json branch = dust::test::run_summary(folder / "more.yaml", folder / "branch", arguments);
  CHECK(carried_out(branch) == approx(carried_out(whole)).epsilon(1e-2));
  CHECK(on_belt(branch) == approx(on_belt(whole)).epsilon(1e-2));
}

// SPDX-License-Identifier: Apache-2.0
// A dust field at bodies thinner than a cell, and the sides that it gets out of.
#include "support/approx.hpp"
#include "support/run_summary.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using dust::test::approx;
using dust::test::run_summary;
using dust::test::TemporaryFolder;
using nlohmann::json;

namespace {

const std::string k_sides = DUST_SOURCE "/tests/scenario/dust_through_sides.yaml";
const std::string k_sheet = DUST_SOURCE "/tests/scenario/dust_at_sheet.yaml";
const std::string k_box = DUST_SOURCE "/tests/scenario/dust_on_box.yaml";

/// What became of a share of the dust that was released.
double share(const json& dust, const char* kind, const char* name) {
  const json& of_kind = dust[kind];
  const auto found = of_kind.find(name);
  return found == of_kind.end() ? 0.0 : found->get<double>() / dust["released_kg"].get<double>();
}

}  // namespace

TEST_CASE("dust of a field shall settle on a sheet thinner than a cell and not fall through it") {
  const TemporaryFolder folder;
  // Level, of 1 mm and of nearly a cell, and on a slant, where it cuts cells in all ways; it
  // reaches up to the cloud there.
  const std::vector<std::vector<std::string>> sheets{
      {},
      {"--set", "bodies.sheet.min=[-40, -10, 25.2 mm]", "--set",
       "bodies.sheet.max=[100, 20, 29.7 mm]"},
      {"--set", "frames.tilted.angle=20 deg"}};
  for (auto sheet : sheets) {
    sheet.emplace_back("--force");
    const json summary = run_summary(k_sheet, folder / "out", sheet);
    const json& dust = summary["dust_field"]["classes"]["50_um"];
    INFO(dust.dump());
    // It sinks 80 mm; of what would fall past the sheet all would lie on the bottom by then.
    CHECK(share(dust, "deposited_kg", "sheet") > 0.98);
    CHECK(share(dust, "deposited_kg", "bottom") == 0.0);
    CHECK(std::abs(dust["balance_error"].get<double>()) < 1e-12);
  }
}

TEST_CASE(
    "a body thinner than a cell shall draw dust in on its own side, however its flow is given") {
  const TemporaryFolder folder;
  const auto drawn = [&](const char* name, const std::string& flow, const char* at) {
    const std::string opening = std::string("[15, 0, ") + at + " mm], max: [45, 10, " + at + " mm]";
    const json summary =
        run_summary(k_sheet, folder / name,
                    {"--set", "bodies.sheet.suction={" + flow + ", min: " + opening + "}", "--set",
                     "domain.boundaries.bottom={grains: open, air: {model: zero_gradient}}"});
    const json& dust = summary["dust_field"]["classes"]["50_um"];
    CHECK(std::abs(dust["balance_error"].get<double>()) < 1e-12);
    return share(dust, "hoods_kg", "sheet");
  };
  // On its upper surface, where the dust comes down.
  const double above = drawn("above", "flow: 0.1 l/s", "27.1");
  CHECK(above > 0.1);
  CHECK(drawn("turned", "flow: -0.1 l/s, times: [0, 1 s], factors: [-1, -1]", "27.1") == above);
  // Below there is none.
  CHECK(drawn("below", "flow: 0.1 l/s", "26.1") == 0.0);
}

TEST_CASE("a turned box shall catch what sinks onto its plan, edges and all") {
  const TemporaryFolder folder;
  for (const double angle : {0.0, 15.0, 30.0, 45.0, 60.0}) {
    for (const bool is_fine : {false, true}) {
      const json summary =
          run_summary(k_box, folder / "out",
                      {"--force", "--set", "frames.turned.angle=" + std::to_string(angle) + " deg",
                       "--set", is_fine ? "fluid.cells=[24, 16, 20]" : "fluid.cells=[12, 8, 10]"});
      const json& dust = summary["dust_field"]["classes"]["50_um"];
      const double turn = angle * std::numbers::pi / 180.0;
      const double plan = 40.0 * std::cos(turn) + 32.0 * std::sin(turn);  // [mm] along x
      const double caught = share(dust, "deposited_kg", "box") * 120.0 * 80.0 / 60.0;
      CAPTURE(angle);
      CAPTURE(caught);
      // Behind its edges a cell's dust is in part in their shelter.
      CHECK(std::abs(caught - plan) < 0.25 * (is_fine ? 5.0 : 10.0));
      CHECK(std::abs(dust["balance_error"].get<double>()) < 1e-12);
    }
  }
}

TEST_CASE("dust that comes off a grain on a sheet shall be in the air of its own side") {
  const TemporaryFolder folder;
  // The grain touches the sheet in the cell whose centre is under it.
  const json summary =
      run_summary(DUST_SOURCE "/tests/scenario/dusty_bounce.yaml", folder / "out",
                  {"--set",
                   "bodies.sheet={shape: box, material: steel, min: [-10, -10, 4.2 mm], max: [50, "
                   "50, 4.6 mm]}"});
  const json& dust = summary["dust_field"]["classes"]["10_um"];
  INFO(dust.dump());
  CHECK(dust["released_kg"].get<double>() > 0.0);
  CHECK(share(dust, "deposited_kg", "sheet") > 0.0);
  CHECK(share(dust, "deposited_kg", "bottom") == 0.0);
}

TEST_CASE("dust shall be told to have left by each side that air passes, open to grains or not") {
  const TemporaryFolder folder;
  const json summary = run_summary(k_sides, folder / "out", {});
  const json& dust = summary["dust_field"]["classes"]["10_um"];
  CHECK(share(dust, "left_kg", "top") > 0.99);
  REQUIRE(summary["dust_outflow"].contains("top"));
  CHECK(summary["dust_outflow"]["top"]["kg"].get<double>() ==
        approx(dust["left_kg"]["top"].get<double>()).epsilon(1e-12));
  CHECK(summary["dust_outflow"].size() == 2);  // and the inlet
  CHECK(summary["dust_rates"].contains("left/top/rate"));
  CHECK_FALSE(summary["dust_rates"].contains("left/right/rate"));
}

TEST_CASE("an opening in a side that is open to grains shall have the dust of its faces alone") {
  const TemporaryFolder folder;
  // The cloud sinks onto the floor; the opening, which hardly draws, or hardly blows in, is a third
  // of what lies below it.
  for (const auto& [flow, way] : {std::pair("1e-6", "hoods_kg"), std::pair("-1e-6", "left_kg")}) {
    CAPTURE(flow);
    const json summary = run_summary(
        k_sides, folder / flow,
        {"--set", "dust.field.classes=[50 um]", "--set", "fluid.initial_velocity=[0, 0, 0]",
         "--set",
         std::string("domain.boundaries.bottom={grains: open, air: {model: hood, flow: ") + flow +
             " l/s, min: [40, 0, 0 mm], max: [60, 10, 0 mm]}}"});
    const json& dust = summary["dust_field"]["classes"]["50_um"];
    CHECK(share(dust, way, "bottom") == approx(1.0 / 3.0).epsilon(1e-3));
    CHECK(share(dust, "deposited_kg", "bottom") == approx(2.0 / 3.0).epsilon(1e-3));
    CHECK(summary["dust_outflow"]["bottom"]["kg"].get<double>() ==
          approx(dust[way]["bottom"].get<double>()).epsilon(1e-12));
  }
}

TEST_CASE("dust in the air where a branch puts a body shall hang beside it, not stay in it") {
  const TemporaryFolder folder;
  const std::string cloud = "dust.field.clouds.cloud.";
  std::vector<std::string> settings = {"--set", cloud + "min=[0, 0, 20 mm]", "--set",
                                       cloud + "max=[120, 80, 70 mm]"};
  auto first = settings;
  first.insert(first.end(), {"--set", "bodies.box.enabled=false", "--set", "time.end=10 ms"});
  static_cast<void>(run_summary(k_box, folder / "first", first));
  settings.insert(settings.end(), {"--set", "start_from=" + (folder / "first").string(), "--set",
                                   "time.end=1.5 s"});
  const json dust =
      run_summary(k_box, folder / "branch", settings)["dust_field"]["classes"]["50_um"];
  INFO(dust.dump());
  CHECK(share(dust, "deposited_kg", "box") > 0.05);
  // It sinks 100 mm at 199 mm/s: all of it lies somewhere by then.
  CHECK(dust["airborne_kg"].get<double>() < 1e-6 * dust["released_kg"].get<double>());
  CHECK(std::abs(dust["balance_error"].get<double>()) < 1e-12);
}

TEST_CASE(
    "dust shall settle on a side that air does not pass as on a floor, open to grains or not") {
  const TemporaryFolder folder;
  // A cloud of 20 mm in height, whose middle is 30 mm up, sinks at 199 mm/s in still air.
  const auto settled = [&](const char* grains) {
    const json summary = run_summary(
        k_sides, folder / "out",
        {"--force", "--set", "dust.field.classes=[50 um]", "--set",
         "fluid.initial_velocity=[0, 0, 0]", "--set", "time.end=0.15 s", "--set",
         std::string("domain.boundaries.bottom={") + grains + ", air: {model: no_slip}}"});
    CHECK_FALSE(summary["dust_outflow"].contains("bottom"));
    const json& dust = summary["dust_field"]["classes"]["50_um"];
    CHECK(std::abs(dust["balance_error"].get<double>()) < 1e-12);
    return share(dust, "deposited_kg", "bottom");
  };
  const double on_wall = settled("grains: wall, material: steel");
  CHECK(on_wall > 0.3);
  CHECK(on_wall < 0.7);
  CHECK(settled("grains: open") == on_wall);
}

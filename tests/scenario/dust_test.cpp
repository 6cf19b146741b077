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

const std::string k_scenario = DUST_SOURCE "/tests/scenario/dust_at_hood.yaml";

/// Runs the scenario into a folder and returns its summary.
json run(const fs::path& out, const std::vector<std::string>& more) {
  return dust::test::run_summary(k_scenario, out, more);
}

}  // namespace

TEST_CASE("a hood shall draw out the grains that reach its opening and book them") {
  const TemporaryFolder folder;
  const json summary = run(folder / "out", {"--set", "dust={finer_than: 50 um, hoods: [hood]}"});
  const json& hood = summary["hoods"]["hood"];
  // All 300 hang less than 16 mm below an opening that sucks 3 l/s through 2.56 cm2.
  CHECK(hood["particles"] == 300);
  CHECK(summary["particles"]["removed"] == 300);
  CHECK(summary["particles"]["in_domain"] == 0);
  CHECK(summary["mass_kg"]["removed"].get<double>() ==
        approx(summary["mass_kg"]["emitted"].get<double>()).epsilon(1e-14));
  CHECK(hood["dust_kg"] == hood["mass_kg"]);
  CHECK(hood["share_of_dust"].get<double>() == approx(1.0));
  CHECK(hood["dust_g_per_tonne"].get<double>() == approx(1e6));
  CHECK_FALSE(hood.contains("field_dust_kg"));
}

TEST_CASE("a hood shall book the dust of a field that it draws out beside that of grains") {
  const TemporaryFolder folder;
  const json summary = run(folder / "out", {"--set", "bodies.hood.suction.flow=8 l/min"});
  const json& hood = summary["hoods"]["hood"];
  const json& field = summary["dust_field"]["classes"]["20_um"];
  const double of_field = hood["field_dust_kg"].get<double>();
  CHECK(of_field > 0.0);
  CHECK(of_field == field["hoods_kg"]["hood"].get<double>());
  const double dust = hood["dust_kg"].get<double>();
  CHECK(dust == approx(hood["mass_kg"].get<double>() + of_field));
  const double fed = summary["mass_kg"]["emitted"].get<double>();
  CHECK(hood["share_of_dust"].get<double>() ==
        approx(dust / (fed + field["released_kg"].get<double>())));
  CHECK(hood["dust_g_per_tonne"].get<double>() == approx(1e6 * dust / fed));
  const json& columns = summary["series"];
  INFO(columns);
  CHECK(columns["hoods/hood/dust [kg]"] == "total");
  CHECK(columns["hoods/hood/field_dust [kg]"] == "total");
}

TEST_CASE("dust as grains and as a field shall meet the same hood in the same share") {
  const TemporaryFolder folder;
  // Weak enough that part of the dust falls past it.
  const json summary = run(folder / "out", {"--set", "bodies.hood.suction.flow=8 l/min"});
  const double grains = summary["hoods"]["hood"]["mass_kg"].get<double>() /
                        summary["mass_kg"]["emitted"].get<double>();
  const json& field = summary["dust_field"]["classes"]["20_um"];
  const double released = field["released_kg"].get<double>();
  const double drawn = field["hoods_kg"]["hood"].get<double>() / released;
  INFO("share of grains " << grains << ", of the field " << drawn);
  // The grains take part of the cloud's room: less than a millionth.
  CHECK(released == approx(1e-3 * 1.728e-6).epsilon(1e-6));
  CHECK(grains > 0.1);
  CHECK(grains < 0.9);
  // Binomial error of 300 grains: 0.03; the field is smeared over a cell, 4 of 12 mm, and has no
  // inertia: grains at rest follow the air with a lag of 3 ms of the 40.
  CHECK(std::abs(drawn - grains) < 0.12);
  CHECK(std::abs(field["balance_error"].get<double>()) < 1e-12);
}

TEST_CASE("a hood shall draw out the same on any threads and after a resume") {
  const json whole = check_same_bits(k_scenario, {}, {"4 ms", "10 ms"}, {"hoods", "dust_field"});
  CHECK(whole["hoods"]["hood"]["particles"] > 20);
}

TEST_CASE("a run that goes on without a hood shall say what that had taken and close its balance") {
  const TemporaryFolder folder;
  const json first = run(folder / "first", {"--set", "bodies.hood.suction.flow=8 l/min"});
  const json& before = first["dust_field"]["classes"]["20_um"];
  const json summary = run(folder / "branch", {"--set", "start_from=" + (folder / "first").string(),
                                               "--set", "time.end=60 ms", "--set", "dust.hoods=[]",
                                               "--set", "bodies.hood.enabled=false"});
  const json& field = summary["dust_field"]["classes"]["20_um"];
  const double drawn = before["hoods_kg"]["hood"].get<double>();
  CHECK(drawn > 0.01 * before["released_kg"].get<double>());
  CHECK(field["released_kg"].get<double>() ==
        approx(before["released_kg"].get<double>() - drawn).epsilon(1e-6));
  CHECK(std::abs(field["balance_error"].get<double>()) < 1e-9);
  const std::string warnings = summary["warnings"].dump();
  CHECK_MESSAGE(warnings.find("kg of dust that bodies or openings had taken which are gone") !=
                    std::string::npos,
                warnings);
}

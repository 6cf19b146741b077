// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/run_summary.hpp"
#include "support/same_bits.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

using dust::test::approx;
using dust::test::check_same_bits;
using dust::test::TemporaryFolder;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string k_duct = DUST_SOURCE "/tests/scenario/dust_in_duct.yaml";
constexpr double k_kg_per_h = 3600.0 * 1e-6;  // of 1 mg/s

json run(const fs::path& out, const std::vector<std::string>& settings) {
  std::vector<std::string> arguments;
  for (const std::string& setting : settings) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  return dust::test::run_summary(k_duct, out, arguments);
}

}  // namespace

TEST_CASE("the rate of dust that leaves a steady stream shall be that of its source, and certain") {
  const TemporaryFolder folder;
  const json summary = run(folder / "out", {});
  const json& rates = summary["dust_rates"];
  CHECK(rates["observed"]["value"].get<double>() == approx(0.5).epsilon(1e-9));
  const json& out = rates["left/right/rate"];
  // It takes 0.16 s through the duct; what lags behind at the edges of the jet has gone by 0.5 s.
  CHECK(out["value"].get<double>() == approx(3.0 * k_kg_per_h).epsilon(1e-6));
  CHECK(out["uncertainty"].get<double>() < 1e-6 * k_kg_per_h);
  CHECK(out["unit"] == "kg/h");
  CHECK(rates["left/all/rate"]["value"] == out["value"]);
  CHECK(rates["left/right/class/3_um/rate"]["value"].get<double>() ==
        approx(k_kg_per_h).epsilon(1e-6));
  CHECK(rates["left/right/class/10_um/rate"]["value"].get<double>() ==
        approx(2.0 * k_kg_per_h).epsilon(1e-6));
  // Nothing is fed, so there is no tonne to refer to; over the whole run less has left.
  CHECK_FALSE(rates.contains("left/right/per_load"));
  CHECK(summary["dust_outflow"]["right"]["kg_per_h"].get<double>() <
        0.9 * out["value"].get<double>());
}

TEST_CASE("a rate of dust taken while the stream begins shall say that it is not steady") {
  const TemporaryFolder folder;
  const json rates =
      run(folder / "out", {"dust.steady_after=5 ms", "time.end=0.2 s"})["dust_rates"];
  CHECK(rates["left/right/rate"]["uncertainty"].is_null());
  CHECK(rates["left/right/rate"]["no_error"] == "not steady");
}

TEST_CASE("rates of dust shall be the same bits on any threads and through a resume") {
  const json whole = check_same_bits(k_duct, {"--set", "dust.steady_after=0.3 s"},
                                     {"0.4 s", "0.6 s"}, {"dust_rates"});
  CHECK(whole["dust_rates"]["left/right/rate"]["value"].get<double>() > 0.0);
}

TEST_CASE("rates of a run that starts from another shall not count what that one has let out") {
  const TemporaryFolder folder;
  const json first = run(folder / "first", {"time.end=0.6 s"});
  // Another seed: averages are not carried over, totals are.
  const json branch = run(folder / "branch", {"time.end=0.8 s", "dust.steady_after=0.3 s", "seed=7",
                                              "start_from=" + (folder / "first").string()});
  const json& rates = branch["dust_rates"];
  CHECK(rates["observed"]["value"].get<double>() <= 0.2 + 1e-9);
  CHECK(rates["left/right/rate"]["value"].get<double>() == approx(3.0 * k_kg_per_h).epsilon(1e-4));
  // So do those of what got out, while its mass goes on.
  const json& out = branch["dust_outflow"]["right"];
  CHECK(out["kg_per_h"].get<double>() == approx(3.0 * k_kg_per_h).epsilon(1e-4));
  CHECK(out["kg"].get<double>() ==
        approx(first["dust_outflow"]["right"]["kg"].get<double>() + 3e-6 * 0.2).epsilon(1e-4));
  CHECK(branch["start_from"]["rates_since_s"].get<double>() == approx(0.6).epsilon(1e-9));
}

TEST_CASE("rates of a branch shall begin in the middle of it where nothing is said") {
  const TemporaryFolder folder;
  run(folder / "first", {"time.end=0.6 s"});
  const std::string from = "start_from=" + (folder / "first").string();
  for (const char* other : {"seed=7", "name=same"}) {
    const json rates = run(folder / other, {"time.end=1 s", other, from})["dust_rates"];
    CHECK(rates["observed"]["value"].get<double>() == approx(0.2).epsilon(1e-9));
    CHECK(rates["left/right/rate"]["value"].get<double>() ==
          approx(3.0 * k_kg_per_h).epsilon(1e-4));
  }
}

TEST_CASE("what sources give shall be told as a rate beside where it goes") {
  const TemporaryFolder folder;
  const json rates = run(folder / "out", {})["dust_rates"];
  CHECK(rates["released/all/rate"]["value"].get<double>() ==
        approx(3.0 * k_kg_per_h).epsilon(1e-9));
  CHECK(rates["released/sources/class/3_um/rate"]["value"].get<double>() ==
        approx(k_kg_per_h).epsilon(1e-9));
}

TEST_CASE("sources beside a load that gives off dust shall be told as a rate of their own") {
  const TemporaryFolder folder;
  const json summary = dust::test::run_summary(
      DUST_SOURCE "/tests/scenario/dusty_stream.yaml", folder / "out",
      {"--set",
       "dust.field.sources={leak: {min: [0, 0, 200 mm], max: [60, 60, 240 "
       "mm], mass_flow: [1 mg/s]}}",
       "--set", "dust.steady_after=0.3 s", "--set", "domain.boundaries.bottom.grains=wall", "--set",
       "domain.boundaries.bottom.material=steel"});
  const json& rates = summary["dust_rates"];
  CHECK(rates["released/sources/rate"]["value"].get<double>() == approx(k_kg_per_h).epsilon(1e-9));
  CHECK(rates["set_free/all/rate"]["value"].get<double>() > 0.0);
  const json& field = summary["dust_field"]["classes"]["10_um"];
  const double came_off =
      summary["dust_on_grains"]["classes"]["10_um"]["set_free_kg"].get<double>();
  CHECK(field["released_kg"].get<double>() == approx(came_off + 0.6 * 1e-6).epsilon(1e-9));
}

TEST_CASE("a run with dust that is extended before its new middle shall be as one never cut") {
  const TemporaryFolder folder;
  const json whole = run(folder / "whole", {"time.end=0.2 s"});
  // Means of the first part had begun, and had not.
  for (const std::string end : {"0.1 s", "0.05 s"}) {
    CAPTURE(end);
    const fs::path out = folder / ("parts" + end);
    run(out, {"time.end=" + end});
    const json resumed =
        dust::test::run_summary(k_duct, out, {"--set", "time.end=0.2 s", "--resume"});
    CHECK(resumed["state_sha256"] == whole["state_sha256"]);
    for (const char* block : {"dust_rates", "stream_indices", "warnings"}) {
      CAPTURE(block);
      CHECK(resumed[block] == whole[block]);
    }
  }
}

TEST_CASE("a run with dust that is extended past its new middle shall say since when means are") {
  const TemporaryFolder folder;
  run(folder / "out", {"time.end=0.1 s"});
  const std::vector<std::string> to_140 = {"--set", "time.end=0.14 s", "--resume"};
  const json late = dust::test::run_summary(k_duct, folder / "out", to_140);
  const std::string warning =
      "dust_rates and stream_indices are means from 0.05 s on, not from the middle of the run, "
      "0.07 s, which had passed when it was given its end of 0.14 s";
  REQUIRE(late["warnings"].size() == 1);
  CHECK(late["warnings"][0].get<std::string>().starts_with(warning));
  CHECK(late["dust_rates"]["observed"]["value"].get<double>() == approx(0.09).epsilon(1e-9));
  // Not where the scenario says when they begin.
  const json kept = dust::test::run_summary(
      k_duct, folder / "given", {"--set", "time.end=0.1 s", "--set", "dust.steady_after=0.05 s"});
  CHECK(kept["warnings"].empty());
  const json given = dust::test::run_summary(
      k_duct, folder / "given",
      {"--set", "time.end=0.14 s", "--set", "dust.steady_after=0.05 s", "--resume"});
  CHECK(given["warnings"].empty());
}

TEST_CASE("a branch with dust that is extended shall begin its means in the middle of the whole") {
  const TemporaryFolder folder;
  run(folder / "base", {"time.end=0.05 s"});
  const std::string from = "start_from=" + (folder / "base").string();
  const json whole = run(folder / "whole", {"time.end=0.25 s", from});
  run(folder / "parts", {"time.end=0.15 s", from});
  const json resumed = dust::test::run_summary(
      k_duct, folder / "parts", {"--set", "time.end=0.25 s", "--set", from, "--resume"});
  for (const char* block : {"dust_rates", "stream_indices", "warnings", "start_from"}) {
    CAPTURE(block);
    CHECK(resumed[block] == whole[block]);
  }
}

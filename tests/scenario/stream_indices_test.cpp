// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/run_summary.hpp"
#include "support/same_bits.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using dust::test::approx;
using dust::test::check_same_bits;
using dust::test::run_summary;
using dust::test::TemporaryFolder;
using nlohmann::json;

namespace {

const std::string k_bounce = DUST_SOURCE "/tests/scenario/dusty_bounce.yaml";
const std::string k_stream = DUST_SOURCE "/tests/scenario/dusty_stream.yaml";
constexpr double k_flow = 0.2;          // kg/s
constexpr double k_area = 0.06 * 0.06;  // m2
constexpr double k_feed = 0.372;        // m
constexpr double k_density = 2000.0;    // kg/m3

double value(const json& figures, const std::string& name) {
  REQUIRE_MESSAGE(figures.contains(name), name);
  return figures[name]["value"].get<double>();
}

/// Of grains that fall freely from the feed, with 1 m/s there, between two heights [m]: they take
/// the time (v_low - v_high)/g for it.
double solids_fraction(double low, double high) {
  const auto speed = [](double z) { return std::sqrt(1.0 + 2.0 * 9.81 * (k_feed - z)); };
  return k_flow / (k_density * k_area) * (speed(low) - speed(high)) / 9.81 / (high - low);
}

}  // namespace

TEST_CASE("the energy of impacts shall be what a bounce dissipates, at the wall it hits") {
  const TemporaryFolder folder;
  const json summary =
      run_summary(k_bounce, folder / "bounce",
                  {"--set", "dust.steady_after=1 ms", "--set", "dust.fall_height=7 mm"});
  const json& indices = summary["stream_indices"];
  const double mass = 3000.0 * std::numbers::pi / 6.0 * std::pow(6e-3, 3);
  const double dissipated = 0.75 * 0.5 * mass * (4.0 + 2.0 * 9.81 * 7e-3);
  CHECK(value(indices, "observed") == approx(11e-3).epsilon(1e-9));
  CHECK(value(indices, "impact/bottom/power") * 11e-3 == approx(dissipated).epsilon(0.02));
  CHECK(value(indices, "impact/all/power") == value(indices, "impact/bottom/power"));
  CHECK_FALSE(indices.contains("impact/grains/power"));
  // One grain that is there from the start: no stream is fed, so nothing per tonne of it, no air
  // that it carries, and no rule of practice that takes a load.
  CHECK_FALSE(indices.contains("impact/all/per_load"));
  CHECK_FALSE(indices.contains("entrained_air/flow"));
  CHECK_FALSE(indices.contains("looseness/void_fraction"));
  CHECK_FALSE(summary["dust_estimates"].contains("induced_air"));
  // 7 mm against 2 m.
  CHECK(value(json{{"f", {{"value", summary["dust_estimates"]["vdi_3790_3"]["over_2_m"]}}}}, "f") ==
        approx(std::pow(0.0035, 1.25)).epsilon(1e-9));
}

TEST_CASE("the energy of all impacts shall have the error of the sum of its causes") {
  const TemporaryFolder folder;
  const std::string rain =
      "emitters.rain={model: feed, material: ore, mass_flow: 0.3 kg/s, min: [8, 8, 34 mm], max: "
      "[32, 32, 34 mm], velocity: [0, 0, -1 m/s], diameters: [3 mm]}";
  const json indices = run_summary(k_bounce, folder / "rain",
                                   {"--set", rain, "--set", "dust.steady_after=100 ms", "--set",
                                    "time.end=600 ms"})["stream_indices"];
  for (const std::string of : {"power", "per_load"}) {
    const auto error = [&](const std::string& cause) {
      const json& figure = indices["impact/" + cause + "/" + of]["uncertainty"];
      REQUIRE_MESSAGE(figure.is_number(), cause << ' ' << indices.dump(1));
      return figure.get<double>();
    };
    const double grains = error("grains"), bottom = error("bottom");
    // Between full agreement and full opposition of the two, as a rule like causes apart.
    CHECK(error("all") > std::abs(grains - bottom));
    CHECK(error("all") < grains + bottom);
  }
}

TEST_CASE("air and looseness of a stream shall be those of grains that fall freely in even air") {
  const TemporaryFolder folder;
  const json summary = run_summary(k_stream, folder / "stream", {"--threads", "1"});
  const json& indices = summary["stream_indices"];
  // All the air that comes in passes every level with the grains: 1 m/s through the shaft.
  CHECK(value(indices, "entrained_air/flow") == approx(k_area).epsilon(2e-3));
  CHECK(value(indices, "entrained_air/per_load") ==
        approx(value(indices, "entrained_air/flow") / (1e-3 * k_flow)).epsilon(0.01));
  // Loosest in the lowest of ten layers, densest in the highest that the stream passes.
  CHECK(value(indices, "looseness/height") == approx(0.02));
  const double loose = solids_fraction(0.0, 0.04), dense = solids_fraction(0.32, 0.36);
  CHECK(1.0 - value(indices, "looseness/void_fraction") == approx(loose).epsilon(0.04));
  CHECK(1.0 - value(indices, "looseness/densest_void_fraction") == approx(dense).epsilon(0.04));
  CHECK(value(indices, "looseness/expansion") == approx(dense / loose).epsilon(0.04));
  CHECK(indices["looseness/expansion"]["uncertainty"].is_null());
  CHECK(indices["entrained_air/per_load"]["uncertainty"].get<double>() >= 0.0);
  const json& air = summary["dust_estimates"]["induced_air"];
  CHECK(air["load_kg_per_s"].get<double>() == approx(k_flow).epsilon(0.01));
  CHECK(air["mean_size_m"].get<double>() == approx(4e-3).epsilon(1e-6));
  // 793.66 short tons/h per 200 kg/s; 1.22047 ft; 0.0131234 ft; 0.0387501 ft2.
  const double by_hand =
      10.0 * 0.0387501 * std::cbrt(0.79366 * 1.22047 * 1.22047 / 0.0131234) * 4.71947e-4;
  CHECK(air["air_m3_per_s"].get<double>() == approx(by_hand).epsilon(0.01));
}

TEST_CASE("the indices of a stream shall be the same bits on any threads and through a resume") {
  // Grains that fall on each other, on the plate and out of the domain.
  const json indices = check_same_bits(
      k_bounce,
      {"--set",
       "emitters.rain={model: feed, material: ore, mass_flow: 0.3 kg/s, min: [8, 8, 34 mm], max: "
       "[32, 32, 34 mm], velocity: [0, 0, -1 m/s], diameters: [3 mm]}",
       "--set", "dust.steady_after=20 ms"},
      {"60 ms", "120 ms"}, {"stream_indices"})["stream_indices"];
  CHECK(value(indices, "impact/grains/power") > 0.0);
  CHECK(value(indices, "impact/bottom/per_load") > 0.0);
  CHECK(value(indices, "looseness/expansion") > 1.0);
}

TEST_CASE("a feed that ends while means are taken shall give no figures per load") {
  const TemporaryFolder folder;
  const json summary =
      run_summary(k_stream, folder / "stream", {"--set", "emitters.feed.end=0.45 s"});
  for (const json& figure : {summary["stream_indices"]["entrained_air/per_load"],
                             summary["dust_rates"]["left/all/per_load"]}) {
    CHECK(figure["value"].is_null());
    CHECK(figure["uncertainty"].is_null());
    CHECK(figure["no_error"] == "feed not even");
  }
  CHECK(value(summary["stream_indices"], "entrained_air/flow") > 0.0);
}

TEST_CASE(
    "a stream that the air does not feel shall have no air drawn along, and no void fraction") {
  const TemporaryFolder folder;
  const json summary = run_summary(k_stream, folder / "stream", {"--set", "coupling.one_way=true"});
  const json& indices = summary["stream_indices"];
  CHECK(indices.contains("observed"));
  for (const auto& figure : indices.items()) {
    CHECK_MESSAGE(!figure.key().starts_with("entrained_air"), figure.key());
    CHECK_MESSAGE(!figure.key().starts_with("looseness"), figure.key());
  }
}

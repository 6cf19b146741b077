// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/run_summary.hpp"
#include "support/same_bits.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

using dust::test::approx;
using dust::test::check_same_bits;
using dust::test::run_summary;
using dust::test::TemporaryFolder;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string k_rain = DUST_SOURCE "/tests/scenario/rain_through_cloud.yaml";
const std::string k_bounce = DUST_SOURCE "/tests/scenario/dusty_bounce.yaml";

/// What is left of a cloud of dust of this diameter [m] after 0.2 s, one grain of `grain` [m] at 5
/// m/s in each cell of 20 mm, `count` of them: eq. (17), (18) of docs/theory/dust.md.
double expected_share(double diameter, double grain, double count) {
  const double knudsen = 2.0 * 66e-9 / diameter;
  const double slip = 1.0 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen));
  const double stokes = 2650.0 * diameter * diameter * slip * 5.0 / (18.0 * 18e-6 * grain);
  const double efficiency = std::pow(stokes / (stokes + 0.25), 2);
  const double area = std::numbers::pi / 4.0 * grain * grain;
  const double gas = 8e-6 - std::numbers::pi / 6.0 * 8e-9;
  return std::exp(-0.2 * count * 5.0 * area * efficiency / gas);
}

double airborne_share(const json& summary, const char* name) {
  const json& of_class = summary["dust_field"]["classes"][name];
  return of_class["airborne_kg"].get<double>() / of_class["released_kg"].get<double>();
}

void check_balances(const json& summary) {
  for (const auto& [name, field] : summary["dust_field"]["classes"].items()) {
    CAPTURE(name);
    CHECK(std::abs(field["balance_error"].get<double>()) < 1e-12);
    if (!summary.contains("dust_on_grains")) continue;
    const json& grains = summary["dust_on_grains"]["classes"][name];
    CHECK(std::abs(grains["balance_error"].get<double>()) < 1e-12);
    CHECK(grains["caught_kg"].get<double>() ==
          approx(field["caught_by_grains_kg"].get<double>()).epsilon(1e-12));
  }
}

}  // namespace

TEST_CASE("a rain of grains shall clear a still cloud as its impaction asks for") {
  const TemporaryFolder folder;
  const json summary = run_summary(k_rain, folder / "out", {});
  REQUIRE(summary["particles"]["in_domain"] == 16);
  // 0.15 % for what the gas slows the grains.
  CHECK(airborne_share(summary, "5_um") == approx(expected_share(5e-6, 2e-3, 1)).epsilon(3e-3));
  CHECK(airborne_share(summary, "40_um") == approx(expected_share(40e-6, 2e-3, 1)).epsilon(3e-3));
  CHECK(airborne_share(summary, "40_um") < 0.7);
  CHECK_FALSE(summary.contains("dust_on_grains"));
  // Between 0.1 and 0.2 s.
  const double share = expected_share(40e-6, 2e-3, 1);
  const double released = summary["dust_field"]["classes"]["40_um"]["released_kg"].get<double>();
  CHECK(summary["dust_rates"]["caught/grains/class/40_um/rate"]["value"].get<double>() ==
        approx(3600.0 / 0.1 * released * (std::sqrt(share) - share)).epsilon(0.01));
  check_balances(summary);
}

TEST_CASE("coarse grains shall catch what those that they stand for would") {
  const TemporaryFolder folder;
  const json summary =
      run_summary(k_rain, folder / "out", {"--set", "materials.ore.coarse_graining=4"});
  // 2 % for what the gas slows grains of 0.5 mm.
  CHECK(airborne_share(summary, "5_um") == approx(expected_share(5e-6, 0.5e-3, 64)).epsilon(0.03));
}

TEST_CASE("grains that carry dust shall take up what they catch, whatever the fluid step") {
  const TemporaryFolder folder;
  const std::vector<std::string> dusty{"--set", "materials.ore.dust_load=[0.1 %, 0.1 %]", "--set",
                                       "dust.liberation={model: energy, binding_energy: 1 MJ/kg}"};
  const auto with_step = [&](const std::string& step) {
    std::vector<std::string> more = dusty;
    more.insert(more.end(), {"--set", "time.fluid_step=" + step});
    return run_summary(k_rain, folder / step, more);
  };
  const json summary = with_step("1 ms");
  check_balances(summary);
  const json& grains = summary["dust_on_grains"]["classes"]["40_um"];
  CHECK(grains["caught_kg"].get<double>() > 0.0);
  CHECK(grains["set_free_kg"].get<double>() == 0.0);
  CHECK(grains["on_grains_kg"].get<double>() ==
        approx(grains["entered_kg"].get<double>() + grains["caught_kg"].get<double>())
            .epsilon(1e-12));
  CHECK(airborne_share(with_step("0.5 ms"), "40_um") ==
        approx(airborne_share(summary, "40_um")).epsilon(1e-3));
}

TEST_CASE("what grains catch shall be the same on any threads and after a resume") {
  // Grains that fall on each other and on the plate through the dust that comes off them.
  const std::vector<std::string> rain{
      "--set", "dust.field.scavenging=true", "--set",
      "emitters.rain={model: feed, material: ore, mass_flow: 0.3 kg/s, min: [8, 8, 34 mm], max: "
      "[32, 32, 34 mm], velocity: [0, 0, -1 m/s], diameters: [3, 5 mm], number_fractions: [0.7, "
      "0.3]}"};
  const json whole =
      check_same_bits(k_bounce, rain, {"36 ms", "80 ms"}, {"dust_on_grains", "dust_field"});
  check_balances(whole);
  CHECK(whole["dust_on_grains"]["classes"]["20_um"]["caught_kg"].get<double>() > 0.0);
}

// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/run_summary.hpp"
#include "support/same_bits.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using dust::test::approx;
using dust::test::check_same_bits;
using dust::test::read_file;
using dust::test::run_summary;
using dust::test::TemporaryFolder;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string k_bounce = DUST_SOURCE "/tests/scenario/dusty_bounce.yaml";

constexpr double k_binding = 100.0;  // J/kg
constexpr double k_load = 0.01;      // kg/kg, both classes
const double k_mass = 3000.0 * std::numbers::pi / 6.0 * std::pow(6e-3, 3);

double sum_of(const json& classes, const char* key) {
  double sum = 0.0;
  for (const auto& [name, of_class] : classes.items()) sum += of_class[key].get<double>();
  return sum;
}

double set_free(const json& summary) {
  return sum_of(summary["dust_on_grains"]["classes"], "set_free_kg");
}

/// Share of the load that an energy [J/kg] of the grain sets free: eq. (8) of docs/theory/dust.md.
double expected_share(double energy, double binding) {
  return -std::expm1(-energy / (k_load * binding));
}

std::string without(std::string text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    const std::size_t at = text.find(part);
    REQUIRE(at != std::string::npos);
    text.erase(at, part.size());
  }
  return text;
}

void check_balances(const json& summary) {
  const json& grains = summary["dust_on_grains"];
  CHECK(grains["kept_back_kg"].get<double>() == 0.0);
  for (const auto& [name, of_class] : grains["classes"].items()) {
    const json& field = summary["dust_field"]["classes"][name];
    CHECK(std::abs(of_class["balance_error"].get<double>()) < 1e-12);
    CHECK(std::abs(field["balance_error"].get<double>()) < 1e-12);
    // What grains have lost: a difference of loads, exact to the rounding of those.
    const double rounding = 1e-14 * of_class["entered_kg"].get<double>();
    const double freed = of_class["set_free_kg"].get<double>();
    CHECK(std::abs(field["released_kg"].get<double>() - freed) < rounding);
    double by_causes = 0.0;
    for (const auto& [cause, amount] : of_class["set_free_by"].items()) {
      by_causes += amount["kg"].get<double>();
    }
    CHECK(std::abs(by_causes - freed) < rounding);
  }
}

}  // namespace

TEST_CASE("a bounce shall set free what the energy that it dissipates asks for") {
  const TemporaryFolder folder;
  for (const std::string restitution : {"0.3", "0.5", "0.7", "0.9"}) {
    CAPTURE(restitution);
    const json summary =
        run_summary(k_bounce, folder / ("e" + restitution),
                    {"--set", "interactions.ore-steel.contact.restitution=" + restitution});
    const double e = std::stod(restitution);
    // 7 mm of fall before the plate.
    const double speed2 = 4.0 + 2.0 * 9.81 * 7e-3;
    const double share = expected_share((1.0 - e * e) * 0.5 * speed2, k_binding);
    CHECK(set_free(summary) == approx(k_load * k_mass * share).epsilon(0.01));
    check_balances(summary);
    const json& fine = summary["dust_on_grains"]["classes"]["10_um"];
    CHECK(fine["entered_kg"].get<double>() == approx(0.004 * k_mass).epsilon(1e-12));
    CHECK(fine["set_free_by"].size() == 1);
    CHECK(fine["set_free_by"]["bottom"]["kg"].get<double>() ==
          approx(fine["set_free_kg"].get<double>()).epsilon(1e-12));
    // One binding energy for both: classes come off as they were loaded.
    CHECK(fine["set_free_kg"].get<double>() == approx(0.4 * set_free(summary)).epsilon(1e-9));
  }
}

TEST_CASE("many bounces shall set free as one that dissipates as much, whatever the fluid step") {
  const TemporaryFolder folder;
  for (const std::string step : {"0.2 ms", "2 ms"}) {
    CAPTURE(step);
    const json summary =
        run_summary(k_bounce, folder / step,
                    {"--set", "time.end=0.6 s", "--set", "time.output_every=0.1 s",
                     // It must not bounce out.
                     "--set", "domain.max=[40, 40, 80 mm]", "--set", "fluid.cells=[5, 5, 10]",
                     "--set", "time.fluid_step=" + step});
    // At rest in the end: all of its energy has been dissipated.
    const double energy = 0.5 * 4.0 + 9.81 * 7e-3;
    CHECK(set_free(summary) ==
          approx(k_load * k_mass * expected_share(energy, k_binding)).epsilon(0.01));
    check_balances(summary);
  }
}

TEST_CASE("a small energy shall set free the same from any load") {
  const TemporaryFolder folder;
  const auto freed = [&](const std::string& load) {
    return set_free(run_summary(k_bounce, folder / ("load" + load),
                                {"--set", "materials.ore.dust_load=[" + load + ", 0]", "--set",
                                 "dust.liberation.binding_energy=1 MJ/kg"}));
  };
  const double energy = 0.75 * 0.5 * (4.0 + 2.0 * 9.81 * 7e-3) * k_mass;
  // 1 % is what the step makes of e = 0.5.
  CHECK(freed("0.01") == approx(energy / 1e6).epsilon(0.02));
  CHECK(freed("0.04") == approx(energy / 1e6).epsilon(0.02));
}

TEST_CASE("moisture shall bind as the law says") {
  const TemporaryFolder folder;
  // AP-42's example: 3 m/s and 0.7 % of moisture give 3.6 g/t finer than 10 um, 0.35 of 0.74.
  const json dry_ore =
      run_summary(k_bounce, folder / "ore", {"--set", "materials.ore.moisture=0.7 %"});
  const json& estimate = dry_ore["dust_estimates"]["ap42_drop"]["ore"];
  const double at_three = 3.6 * 0.74 / 0.35;
  for (const auto& [key, wind] : {std::pair{"least_g_per_tonne", 0.6}, {"most_g_per_tonne", 6.7}}) {
    CHECK(estimate[key].get<double>() ==
          approx(at_three * std::pow(wind / 3.0, 1.3)).epsilon(0.02));
  }
  const auto freed = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(), {"--set", "dust.liberation.binding_energy=1 MJ/kg"});
    return set_free(run_summary(k_bounce, folder / name, more));
  };
  const double dry = freed("dry", {});
  // AP-42: the power -1.4; a drum test: ten times at 3 % more.
  const double wet = freed("wet", {"--set", "materials.ore.moisture=2 %"});
  CHECK(wet / dry == approx(std::pow(2.0, -1.4)).epsilon(1e-4));
  CHECK(
      dust::test::read_file(folder / "wet" / "run.log")
          .find("material ore: at 2 % of moisture a gentle impact sets free 0.379 of what it does "
                "at 1 %") != std::string::npos);
  // Without moisture: AP-42's power ends at 0.25 %, which is 7 times the dust; a drum test's has no
  // end.
  const auto says = [&](const std::string& name, const std::string& line) {
    return dust::test::read_file(folder / name / "run.log").find(line) != std::string::npos;
  };
  const double none = freed("none", {"--set", "materials.ore.moisture=0"});
  CHECK(none / dry == approx(std::pow(0.25, -1.4)).epsilon(1e-3));  // eq. (8) bends
  CHECK(says("none",
             "material ore: no moisture given: counts as 0.25 %, a gentle impact sets free 6.96 of "
             "what it does at 1 %"));
  freed("none_drum",
        {"--set", "materials.ore.moisture=0", "--set", "dust.liberation.moisture_scale=3 %"});
  CHECK(says("none_drum",
             "material ore: no moisture given: dry, a gentle impact sets free 2.15 of what it does "
             "at 1 %"));
  const double drum = freed("drum", {"--set", "materials.ore.moisture=4 %", "--set",
                                     "dust.liberation.moisture_scale=3 %"});
  CHECK(drum / dry == approx(0.1).epsilon(1e-4));
}

TEST_CASE("what comes off shall be the same on any threads and after a resume") {
  // Grains that fall on each other, on the plate and out of the domain.
  const std::vector<std::string> rain{
      "--set",
      "emitters.rain={model: feed, material: ore, mass_flow: 0.3 kg/s, min: [8, 8, 34 mm], max: "
      "[32, 32, 34 mm], velocity: [0, 0, -1 m/s], diameters: [3, 5 mm], number_fractions: [0.7, "
      "0.3]}"};
  const json whole =
      check_same_bits(k_bounce, rain, {"48 ms", "120 ms"}, {"dust_on_grains", "dust_field"});
  check_balances(whole);
  const json& coarse = whole["dust_on_grains"]["classes"]["20_um"];
  CHECK(coarse["left_with_grains_kg"].get<double>() > 0.0);
  CHECK(coarse["set_free_by"]["grains"]["kg"].get<double>() > 0.0);
  CHECK(coarse["set_free_by"]["bottom"]["kg"].get<double>() > 0.0);
}

TEST_CASE("wind shall take dust off as its shear over the threshold asks for") {
  const TemporaryFolder folder;
  const auto blow = [&](const std::string& speed) {
    return run_summary(DUST_SOURCE "/tests/scenario/grain_in_wind.yaml", folder / speed,
                       {"--set", "domain.boundaries.left.air.speed=" + speed + " m/s", "--set",
                        "fluid.initial_velocity=[" + speed + ", 0, 0 m/s]"});
  };
  // Friction velocity of a drag coefficient of 0.44, spread over the sphere; its threshold after
  // Shao and Lu; eq. (14), (15) of docs/theory/dust.md.
  const auto expected = [](double speed, double diameter) {
    const double u2 = 0.44 * speed * speed / 8.0;
    const double threshold2 = 0.0123 * (3000.0 / 1.2 * 9.81 * diameter + 3e-4 / (1.2 * diameter));
    const double flux = 1e-3 * 1.2 / 9.81 * std::pow(u2, 1.5) * (1.0 - threshold2 / u2);
    const double area = std::numbers::pi * 6e-3 * 6e-3;
    return -std::expm1(-flux * area * 20e-3 / (k_load * k_mass));
  };
  double before = 0.0;
  for (const std::string speed : {"3", "5", "9"}) {
    CAPTURE(speed);
    const json summary = blow(speed);
    check_balances(summary);
    const json& classes = summary["dust_on_grains"]["classes"];
    const double fine = classes["10_um"]["set_free_kg"].get<double>();
    const double coarse = classes["40_um"]["set_free_kg"].get<double>();
    CHECK(fine == approx(0.004 * k_mass * expected(std::stod(speed), 10e-6)).epsilon(0.002));
    CHECK(coarse == approx(0.006 * k_mass * expected(std::stod(speed), 40e-6)).epsilon(0.002));
    // Taken off the load in each of 20 steps, to the rounding of that.
    const double rounding = 20.0 * std::numeric_limits<double>::epsilon() * 0.006 * k_mass;
    CHECK(std::abs(classes["40_um"]["set_free_by"]["wind"]["kg"].get<double>() - coarse) <
          rounding);
    CHECK(coarse > before);
    before = coarse;
  }
  CHECK(set_free(blow("1")) == 0.0);
}

TEST_CASE("what else acts on a grain shall be no wind") {
  // A lump at rest in still air, which carries 0.05 % of its weight: as drag that would be a wind
  // of 1.5 m/s, and more than the threshold.
  const TemporaryFolder folder;
  for (const std::string forces : {"[]", "[{model: archimedes}]", "[{model: virtual_mass}]"}) {
    CAPTURE(forces);
    const json summary = run_summary(
        DUST_SOURCE "/tests/scenario/grain_in_wind.yaml", folder / "still",
        {"--force", "--set", "domain.boundaries.left.air.speed=0 m/s", "--set",
         "fluid.initial_velocity=[0, 0, 0 m/s]", "--set", "domain.max=[400, 400, 400 mm]", "--set",
         "emitters.grain.positions=[[200, 200, 50 mm]]", "--set",
         "emitters.grain.diameters=[100 mm]", "--set", "fluid_forces=" + forces});
    check_balances(summary);
    CHECK(set_free(summary) == 0.0);
  }
}

TEST_CASE("a coarse grain shall lose the share of its dust that the grains it stands for lose") {
  const TemporaryFolder folder;
  const auto share = [&](const std::string& file, const std::string& name,
                         std::vector<std::string> more) {
    more.emplace_back("--force");
    const json summary = run_summary(file, folder / name, more);
    check_balances(summary);
    return set_free(summary) / sum_of(summary["dust_on_grains"]["classes"], "entered_kg");
  };
  // 12 mm for eight of 6 mm, and 18 mm for 27.
  for (const int l : {2, 3}) {
    CAPTURE(l);
    const auto coarse = [l](const std::string& emitter, const std::string& centre) {
      return std::vector<std::string>{
          "--set", "materials.ore.coarse_graining=" + std::to_string(l),
          "--set", "emitters." + emitter + ".diameters=[" + std::to_string(6 * l) + " mm]",
          "--set", "emitters." + emitter + ".positions=[[" + centre + " mm]]"};
    };
    const std::string wind = DUST_SOURCE "/tests/scenario/grain_in_wind.yaml";
    const double blown = share(wind, "wind", {});
    CHECK(blown > 0.0);
    CHECK(share(wind, "coarse_wind", coarse("grain", "50, 50, " + std::to_string(3 * l))) ==
          approx(blown).epsilon(0.002));
    // Both fall 7 mm onto the plate; what shakes the smaller ones is l times as large.
    for (const std::string law :
         {"energy, binding_energy: 100 J/kg, size_exponent: 0",
          "force_ratio, binding_force: 1e-7 N, reference_diameter: 20 um"}) {
      CAPTURE(law);
      const std::vector<std::string> by_law{"--set", "dust.liberation={model: " + law + "}"};
      std::vector<std::string> more = coarse("drop", "20, 20, " + std::to_string(7 + 3 * l));
      more.insert(more.end(), by_law.begin(), by_law.end());
      const double shaken = share(k_bounce, "fine", by_law);
      CHECK(shaken > 0.05);
      CHECK(shaken < 0.95);
      // Their contacts are computed in steps of their own.
      CHECK(share(k_bounce, "coarse", more) == approx(shaken).epsilon(0.02));
    }
  }
}

TEST_CASE("grains shall keep their dust in a feed zone, and lose it elsewhere as without one") {
  const TemporaryFolder folder;
  const std::string wind = DUST_SOURCE "/tests/scenario/grain_in_wind.yaml";
  const auto zone = [](const char* corners) {
    return std::vector<std::string>{"--set",
                                    std::string("dust.feed_zones={feed: ") + corners + "}"};
  };
  for (const std::string& file : {k_bounce, wind}) {
    CAPTURE(file);
    const std::string name = file == wind ? "wind" : "bounce";
    const json none = run_summary(file, folder / (name + "_none"), {});
    const json over = run_summary(file, folder / (name + "_over"),
                                  zone("{min: [0, 0, 8 mm], max: [40, 40, 40 mm]}"));
    const json here =
        run_summary(file, folder / (name + "_here"), zone("{min: [0, 0, 0], max: [99, 99, 8 mm]}"));
    CHECK(set_free(none) > 0.0);
    // It bounces below 8 mm.
    CHECK(set_free(over) == set_free(none));
    CHECK(set_free(here) == 0.0);
    check_balances(here);
    CHECK(sum_of(here["dust_on_grains"]["classes"], "entered_kg") > 0.0);
  }
}

TEST_CASE("a run that starts from another shall go on with its loads and with what came off") {
  const TemporaryFolder folder;
  const json first = run_summary(k_bounce, folder / "first", {"--set", "time.end=6 ms"});
  const fs::path variant = folder / "variant.yaml";
  std::ofstream(variant) << "include: " << k_bounce
                         << "\nstart_from: " << (folder / "first").string()
                         << "\ntime: {end: 12 ms}\nbodies: {shelf: {shape: box, material: steel, "
                            "min: [0, 0, 30 mm], max: [4, 4, 31 mm]}}\n";
  const json second = run_summary(variant, folder / "second", {});
  check_balances(second);
  const json whole = run_summary(k_bounce, folder / "whole", {});
  CHECK(set_free(first) > 0.0);
  CHECK(set_free(second) >= set_free(first));
  // The shelf is out of the way: what came off is what would have come off without it.
  CHECK(set_free(second) == approx(set_free(whole)).epsilon(1e-6));
  CHECK(sum_of(second["dust_on_grains"]["classes"], "entered_kg") ==
        approx(k_load * k_mass).epsilon(1e-12));
}

TEST_CASE("a run whose grains carry no dust shall keep its bits") {
  const TemporaryFolder folder;
  // The work of contacts is kept beside the forces, never in them. So wet that nothing comes off:
  // dust in the air would weigh on it.
  const json with = run_summary(
      k_bounce, folder / "with",
      {"--set", "materials.ore.moisture=90 %", "--set", "dust.liberation.moisture_scale=0.01 %"});
  REQUIRE(with["dust_on_grains"]["classes"]["10_um"]["set_free_kg"].get<double>() == 0.0);
  const fs::path plain = folder / "plain.yaml";
  std::ofstream(plain) << without(read_file(k_bounce),
                                  {", dust_load: [0.4 %, 0.6 %], moisture: 1 %",
                                   "  liberation: {model: energy, binding_energy: 100 J/kg, "
                                   "size_exponent: 0}\n"});
  CHECK(with["state_sha256"] == run_summary(plain, folder / "without", {})["state_sha256"]);
}

// SPDX-License-Identifier: Apache-2.0
#include "preflight/derived.hpp"
#include "support/approx.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <tuple>

using namespace dust;

namespace {
// Closed forms, evaluated in another order: a few roundings.
constexpr double k_roundings = 1e-12;
}  // namespace

TEST_CASE("the Rayleigh time shall be that of its formula with the nu term outside the root") {
  // R = 0.3 mm, rho = 2650, E = 50 MPa, nu = 0.3: G = 19.2307692 MPa, root(rho/G) = 0.011738824,
  // pi R root / (0.04893 + 0.8766) = 1.195378e-5 s.
  const sdk::MaterialProperties sand{2650, 5e7, 0.3};
  CHECK(particles::rayleigh_time(sand, 3e-4) == test::approx(1.195378e-5).epsilon(1e-6));
  CHECK(particles::rayleigh_time(sand, 6e-4) ==
        test::approx(2 * particles::rayleigh_time(sand, 3e-4)).epsilon(k_roundings));
}

TEST_CASE("the smallest grain shall set the step and each step shall keep both shares") {
  const auto setup = read(transfer_point()).setup;
  const particles::TimeSteps steps = preflight::derive(setup, fakes()).steps;
  REQUIRE(steps.classes.size() == 5);
  CHECK(steps.deciding() == &steps.classes[0]);
  for (const auto& size : steps.classes) {
    CHECK(size.stable_step == test::approx(std::min(0.3 * size.rayleigh_time, size.hertz_time / 15))
                                  .epsilon(k_roundings));
  }
  CHECK(steps.finest_step() <= steps.classes[0].stable_step);
  CHECK(steps.finest_step() > 0.5 * steps.classes[0].stable_step);
  // Grains of more than an eighth of the largest, here from 300 um on, share the step of the
  // smallest of them, a whole part of the fluid's.
  CHECK(steps.coarse_deciding() == &steps.classes[1]);
  const double parts = setup.time.fluid_step / steps.coarse_step;
  CHECK(parts == test::approx(std::ceil(setup.time.fluid_step / steps.classes[1].stable_step))
                     .epsilon(k_roundings));
}

TEST_CASE(
    "a fixed step shall replace the derived one, and fine grains still be stepped as they need") {
  const auto setup = read(transfer_point(), {{"time.dem_step", "1e-7"}}).setup;
  const particles::TimeSteps steps = preflight::derive(setup, fakes()).steps;
  CHECK(steps.coarse_step == test::approx(1e-7).epsilon(k_roundings));
  // The finest is stable at 0.05 us or less: halved until it is.
  const particles::ClassStep& finest = steps.classes.front();
  CHECK(finest.stable_step < 0.5 * steps.coarse_step);
  CHECK(steps.step_of(finest) <= finest.stable_step);
  CHECK(2.0 * steps.step_of(finest) > finest.stable_step);
  CHECK(steps.step_of(steps.classes[1]) == steps.coarse_step);
}

TEST_CASE("the expected speed shall be that of bodies and the fall through the domain") {
  auto setup = read(transfer_point()).setup;
  // belt 0.8 m/s, fall 0.35 m: root(0.64 + 2 * 9.81 * 0.35)
  CHECK(preflight::derive(setup, fakes()).expected_speed ==
        test::approx(std::sqrt(0.64 + 2 * 9.81 * 0.35)).epsilon(k_roundings));
  // Steps follow from the belt alone.
  CHECK(preflight::derive(setup, fakes()).steps.expected_speed == 0.8);
  setup.time.expected_speed = 1.5;
  CHECK(preflight::derive(setup, fakes()).expected_speed == 1.5);
  CHECK(preflight::derive(setup, fakes()).steps.expected_speed == 1.5);
}

TEST_CASE("steps shall follow from how fast grains are let in") {
  const auto speed = [](const std::string& velocity) {
    const auto setup = read(transfer_point(), {{"emitters.feed.velocity", velocity}}).setup;
    return preflight::derive(setup, fakes()).steps.expected_speed;
  };
  CHECK(speed("[12, 0, -16 m/s]") == 20.0);
  CHECK(speed("[0.7, 0, 0 m/s]") == 0.8);  // the belt
}

TEST_CASE("ratios and the rate of grains shall follow from the scenario") {
  const auto setup = read(transfer_point()).setup;
  const auto derived = preflight::derive(setup, fakes());
  CHECK(derived.smallest_spacing == test::approx(0.011 / 9).epsilon(k_roundings));
  CHECK(derived.diameter_over_spacing == test::approx(6e-4 * 9 / 0.011).epsilon(k_roundings));
  CHECK(derived.width_over_diameter == test::approx(0.011 / 6e-4).epsilon(k_roundings));
  // The fake feed sends ten grains per millisecond.
  REQUIRE(derived.emissions.size() == 1);
  CHECK(derived.emissions[0].computed_per_second == test::approx(1e4).epsilon(k_roundings));
}

TEST_CASE("the estimates shall be within a factor of two of what the transfer point took") {
  registry::Registry shipped;
  shipped.load({DUST_TEST_PLUGINS});
  const auto estimate = [&](const std::vector<scenario::Override>& set) {
    const auto file = std::string(DUST_SOURCE) + "/scenarios/transfer_point.yaml";
    return preflight::derive(preflight::read_scenario(file, set, shipped).setup, shipped);
  };
  const auto is_near = [](double reported, double measured) {
    return reported > 0.5 * measured && reported < 2.0 * measured;
  };
  // Measured on 2 cores of 2026: processor time, peak memory, size of the folder, grains at the
  // end.
  const auto part = estimate({{"time.end", "0.45"}, {"time.output_every", "0.02"}});
  CHECK(is_near(part.cost.terms.seconds(), 431));
  CHECK(is_near(part.cost.memory_bytes, 670e6));
  CHECK(is_near(part.cost.disk_bytes, 259e6));
  CHECK(is_near(part.grains_in_domain, 15664));
  // docs/performance.md: whole, and without air.
  CHECK(is_near(estimate({}).cost.terms.seconds(), 813));
  const auto airless = estimate({{"fluid", "none"}});
  CHECK(is_near(airless.cost.terms.seconds(), 272));
  CHECK(is_near(airless.cost.memory_bytes, 63e6));
}

TEST_CASE(
    "steps at finer rates shall be told within a factor of 1.5 of those that the transfer "
    "point made, on fast belts and slow ones, under thin loads and deep ones") {
  registry::Registry shipped;
  shipped.load({DUST_TEST_PLUGINS});
  const auto steps = [&](const std::string& speed, bool is_thin) {
    std::vector<scenario::Override> set = {{"time.end", "1 s"}, {"bodies.belt.speed", speed}};
    if (is_thin) {
      set.insert(set.end(), {{"emitters.feed.mass_flow", "1 g/s"},
                             {"emitters.feed.min", "[28, 3.5, 220 mm]"},
                             {"emitters.feed.max", "[32, 7.5, 220 mm]"}});
    }
    const auto file = std::string(DUST_SOURCE) + "/scenarios/transfer_point.yaml";
    const auto derived =
        preflight::derive(preflight::read_scenario(file, set, shipped).setup, shipped);
    return derived.cost.terms[preflight::CostTerm::fine_grains].amount;
  };
  // `fine_particle_steps` of the summaries of studies/figure_6_15.yaml and table_6_4_speed.yaml.
  struct Made {
    const char* speed;
    bool is_thin;
    double steps;
  };
  for (const auto& [speed, is_thin, made] :
       {Made{"0.8 m/s", true, 3.35e8}, Made{"0.2 m/s", true, 1.05e9},
        Made{"0.8 m/s", false, 2.21e9}, Made{"0.2 m/s", false, 3.32e9}}) {
    CAPTURE(speed);
    CAPTURE(is_thin);
    CHECK(steps(speed, is_thin) > made / 1.5);
    CHECK(steps(speed, is_thin) < made * 1.5);
  }
}

TEST_CASE("the disk shall be estimated within a factor of 1.5 of what runs leave on it") {
  registry::Registry shipped;
  shipped.load({DUST_TEST_PLUGINS});
  // docs/validation/estimates.md: frames of a field, a thin grid (its halo is half of what is
  // stored), grains in air, a sphere that the grid resolves, a plant. The factor is the page's.
  for (const auto& [scenario, end, left] :
       {std::tuple{"dust/plume.yaml", "10.5 s", 536e6},
        std::tuple{"dust/same_dust_twice.yaml", "0.2 s", 62.6e6},
        std::tuple{"transfer_point.yaml", "0.043 s", 180e6},
        std::tuple{"thesis/settling_b1_resolved.yaml", "0.2475 s", 133e6},
        std::tuple{"plant/transfer_chute.yaml", "0.302 s", 95e6}}) {
    CAPTURE(scenario);
    const auto file = std::string(DUST_SOURCE) + "/scenarios/" + scenario;
    const auto read = preflight::read_scenario(file, {{"time.end", end}}, shipped);
    const double estimated = preflight::derive(read.setup, shipped, read.dust).cost.disk_bytes;
    CHECK(estimated < 1.5 * left);
    CHECK(estimated > left / 1.5);
  }
}

TEST_CASE("lone grains whose own disturbance is taken off shall be estimated dearer, as they are") {
  registry::Registry shipped;
  shipped.load({DUST_TEST_PLUGINS});
  const auto exchange_of = [&](const std::string& scenario, const std::string& mode) {
    const auto file = std::string(DUST_SOURCE) + "/scenarios/" + scenario;
    const auto setup =
        preflight::read_scenario(file, {{"coupling.correct_own_disturbance", mode}}, shipped).setup;
    return preflight::derive(setup, shipped).cost.terms[preflight::CostTerm::exchange].seconds;
  };
  // Measured on one core of 2026; a factor of two either way, for machines differ by that.
  for (const auto& [scenario, taken] :
       {std::pair{"dust/enclosed_chute.yaml", 4.8}, std::pair{"studies/small_transfer.yaml", 5.8},
        std::pair{"thesis/settling_b2.yaml", 4.5}}) {
    CAPTURE(scenario);
    const double estimated = exchange_of(scenario, "true");
    CHECK(estimated > 0.5 * taken);
    CHECK(estimated < 2.0 * taken);
    CHECK(exchange_of(scenario, "false") < 0.7 * estimated);
  }
}

TEST_CASE("sub-steps of the air shall be estimated by what drives it") {
  registry::Registry shipped;
  shipped.load({DUST_TEST_PLUGINS});
  const auto air_speed_of = [&](const std::string& scenario,
                                const std::vector<scenario::Override>& set) {
    const auto file = std::string(DUST_SOURCE) + "/scenarios/dust/" + scenario;
    const auto read = preflight::read_scenario(file, set, shipped);
    return preflight::derive(read.setup, shipped, read.dust).air_speed;
  };
  // 120 l/min through 60 x 20 mm, 2.5 times as fast at its edges.
  CHECK(air_speed_of("hood_over_drop.yaml", {}) == test::approx(2.5 * 0.002 / 0.0012));
  // A wind of 2 m/s comes in, whatever the grains do.
  CHECK(air_speed_of("slug_in_wind.yaml", {}) == test::approx(2.0));
  // 8 g/min that falls 0.5 m at 3 m/s cannot make the air as fast: a plume's speed.
  const double plume = 4.7 * std::cbrt(9.81 * 0.008 / 60.0 / (1.2 * 0.05));
  CHECK(air_speed_of("continuous_drop.yaml", {}) == test::approx(plume));
  // A thousand times that: as fast as the grains come in, and half a free fall besides.
  CHECK(air_speed_of("continuous_drop.yaml", {{"emitters.stream.mass_flow", "8 kg/min"}}) ==
        test::approx(std::hypot(2.8, 0.5 * std::sqrt(2.0 * 9.81 * 0.5))));
}

TEST_CASE("grains with bridges shall be told dearer than dry ones, as they are") {
  registry::Registry shipped;
  shipped.load({DUST_TEST_PLUGINS});
  const auto grains_of = [&](const std::string& scenario) {
    const auto file = std::string(DUST_SOURCE) + "/scenarios/studies/" + scenario;
    const auto setup = preflight::read_scenario(file, {}, shipped).setup;
    return preflight::derive(setup, shipped).cost.terms[preflight::CostTerm::grains].seconds;
  };
  // Measured on one core of 2026; a factor of two either way, for machines differ by that.
  for (const auto& [scenario, taken] :
       {std::pair{"wet_hopper.yaml", 3.9}, std::pair{"small_hopper.yaml", 1.35}}) {
    CAPTURE(scenario);
    CHECK(grains_of(scenario) > 0.5 * taken);
    CHECK(grains_of(scenario) < 2.0 * taken);
  }
}

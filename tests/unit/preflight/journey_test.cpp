// SPDX-License-Identifier: Apache-2.0
#include "preflight/journey.hpp"
#include "preflight/cost.hpp"
#include "preflight/particle_models.hpp"
#include "support/approx.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace dust;
using preflight::grain_seconds;
using preflight::most_grains;

namespace {

constexpr double k_never = std::numeric_limits<double>::infinity();

/// A box of 1 x 0.2 x 1 m, open all round, with a belt up to x = 0.5 m at z = 0.5 m.
struct Place {
  Folder folder;
  registry::Registry shipped;
  scenario::Setup setup;
  preflight::ParticleModels models;

  explicit Place(const std::vector<scenario::Override>& set) {
    shipped.load({DUST_TEST_PLUGINS});
    const auto file = folder.write("belt.yaml", R"(
name: belt
time: {end: 10 s, fluid_step: 1 ms, output_every: 1 s}
gravity: [0, 0, -9.81]
domain:
  min: [0, 0, 0 m]
  max: [1, 0.2, 1 m]
  boundaries:
    left: {grains: open}
    right: {grains: open}
    front: {grains: open}
    back: {grains: open}
    bottom: {grains: open}
    top: {grains: open}
materials:
  sand: {density: 2650, young_modulus: 5 MPa, poisson_ratio: 0.3}
  rubber: {density: 1100, young_modulus: 5 MPa, poisson_ratio: 0.3}
interactions:
  - between: [sand, sand]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
  - between: [sand, rubber]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
bodies:
  belt: {shape: conveyor, material: rubber, head: [0.5, 0, 0.45 m], tail: [-1, 0, 0.45 m], radius: 0.047 m, thickness: 3 mm, motion: belt, speed: 1 m/s}
emitters:
  feed: {model: feed, material: sand, mass_flow: 1 kg/s, min: [0.1, 0.02, 0.6 m], max: [0.2, 0.18, 0.6 m], velocity: [0, 0, -1 m/s], diameters: [10 mm], mass_fractions: [1]}
fluid: none
)");
    setup = preflight::read_scenario(file, set, shipped).setup;
    models = preflight::make_particle_models(setup, shipped);
  }

  [[nodiscard]] preflight::Journey follow(sdk::Vec3 from, sdk::Vec3 velocity,
                                          double longest = 10.0) const {
    sdk::InsertionRequest grain;
    grain.position = from;
    grain.velocity = velocity;
    grain.diameter = 0.01;
    return preflight::follow_grain(setup, models.bodies, grain, longest);
  }
};

}  // namespace

TEST_CASE("a stream shall be counted by the integral of its number over the run") {
  // One per second for the whole run of 10 s: it grows for 2 s, then stays at 2.
  CHECK(grain_seconds(0, k_never, 2, 10) == test::approx(2.0 * 10.0 - 2.0));
  CHECK(most_grains(0, k_never, 2, 10) == 2.0);
  // Nobody leaves: t^2 / 2.
  CHECK(grain_seconds(0, k_never, k_never, 10) == test::approx(50.0));
  CHECK(most_grains(0, k_never, k_never, 10) == 10.0);
  // For 3 s from 1 s on, each for 2 s, all gone before the end.
  CHECK(grain_seconds(1, 4, 2, 10) == test::approx(3.0 * 2.0));
  // The same, but the run ends at 5 s: those of the last second stay 2 to 1 s.
  CHECK(grain_seconds(1, 4, 2, 5) == test::approx(2.0 * 2.0 + 1.5));
  CHECK(most_grains(1, 4, 20, 5) == 3.0);
  CHECK(grain_seconds(6, 8, 2, 5) == 0.0);
  CHECK(most_grains(6, 8, 2, 5) == 0.0);
}

TEST_CASE("a grain shall stay in the domain for its fall and for its way on the belt") {
  const Place place({});
  // Beside the belt: 0.6 m from rest.
  const auto fall = place.follow({0.8, 0.1, 0.6}, {});
  CHECK(fall.duration == test::approx(std::sqrt(2.0 * 0.6 / 9.81)).epsilon(0.05));
  CHECK(fall.carried == 0.0);
  // On the belt: 0.4 m at 1 m/s, too fast to go round the pulley, then 0.505 m down.
  const auto carried = place.follow({0.1, 0.1, 0.505}, {1, 0, 0});
  CHECK(carried.carried == test::approx(0.4).epsilon(0.05));
  CHECK(carried.carried_way == test::approx(0.4).epsilon(0.05));
  CHECK(carried.duration == test::approx(0.4 + std::sqrt(2.0 * 0.505 / 9.81)).epsilon(0.05));
  // From rest it slides until friction has brought it to the belt's speed: v^2 / (2 mu g) = 0.1 m.
  const auto slides = place.follow({0.1, 0.1, 0.505}, {});
  const double by_friction = 1.0 / (0.5 * 9.81);
  CHECK(slides.carried == test::approx(by_friction + 0.4 - 0.5 * by_friction).epsilon(0.05));
}

TEST_CASE("a grain that comes to rest, or is held by walls, shall stay") {
  const std::vector<scenario::Override> at_rest = {{"bodies.belt.speed", "0 m/s"}};
  const Place still(at_rest);
  CHECK(still.follow({0.1, 0.1, 0.6}, {}).duration == k_never);
  const Place closed({{"domain.boundaries.bottom", "{grains: wall, material: rubber}"},
                      {"domain.boundaries.right", "{grains: wall, material: rubber}"}});
  CHECK(closed.follow({0.8, 0.1, 0.6}, {0.5, 0, 0}).duration == k_never);
}

TEST_CASE("the cost of grains shall be that of their steps, level by level") {
  const Place place({});
  auto derived = preflight::derive(place.setup, place.shipped);
  const double steps = place.setup.time.end / derived.steps.coarse_step;
  const auto& feed = derived.emissions.at(0);
  double mean = 0.0;
  for (const double stay : feed.stays) {
    mean += grain_seconds(0, k_never, stay, 10.0) / 10.0 / static_cast<double>(feed.stays.size());
  }
  CHECK(derived.cost.terms[preflight::CostTerm::grains].amount ==
        test::approx(feed.computed_per_second * mean * steps));
  CHECK(derived.cost.terms[preflight::CostTerm::fine_grains].amount == 0.0);
  CHECK(derived.cost.terms[preflight::CostTerm::fluid].seconds == 0.0);
  CHECK(derived.cost.terms[preflight::CostTerm::output].amount == 11.0);
}

TEST_CASE("a deep load shall have the contacts of a bed, a single layer none") {
  CHECK(preflight::carried_contacts(0.5) == 0.0);
  CHECK(preflight::carried_contacts(1.0) == 0.0);
  const double bed = preflight::carried_contacts(1e9);
  CHECK(bed == test::approx(2.5));
  // Twice the layers that lie side by side, and four times.
  CHECK(preflight::carried_contacts(2.4) == test::approx(0.5 * bed));
  CHECK(preflight::carried_contacts(4.8) == test::approx(0.75 * bed));
}

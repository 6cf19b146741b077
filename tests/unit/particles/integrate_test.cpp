// SPDX-License-Identifier: Apache-2.0
#include "support/dem_rig.hpp"

#include "dust/sdk/random.hpp"

#include <doctest/doctest.h>

#include <utility>
#include <vector>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using namespace dust::test;

namespace {

/// A hundred pairs that touch, spin and part, and a grain on its own: an odd number. With a flyer
/// far off, which came earlier and sleeps, not all of the tile is active.
std::unique_ptr<dust::particles::Dem> hundred_pairs(bool has_flyer, bool has_air) {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.7, 0.4, 0.2);
  rig.diameters = {500e-6, 600e-6};
  rig.setup.gravity = {0, 0, -9.81};
  rig.has_fluid = has_air;
  auto dem = rig.make();
  if (has_flyer) {
    NewGrain flyer;
    flyer.diameter = 600e-6;
    flyer.position = {-0.9, -0.9, -0.9};
    dem->insert(std::vector{flyer});
    Stepper(*dem).step(200);
  }
  const dust::sdk::Random random(7, 1);
  std::vector<NewGrain> grains(201);
  for (std::size_t n = 0; n < grains.size(); ++n) {
    NewGrain& g = grains[n];
    const auto draw = [&](std::uint32_t slot) { return random.uniform(n, 0, slot) - 0.5; };
    g.diameter = n % 3 == 0 ? 500e-6 : 600e-6;
    g.position = {5e-3 * static_cast<double>(n / 2), n % 2 == 0 ? 0.0 : 0.545e-3, 0.0};
    g.velocity = 0.2 * Vec3{draw(1), draw(2), draw(3)};
    g.rotation = 300.0 * Vec3{draw(4), draw(5), draw(6)};
    g.position.x -= 0.5;
  }
  dem->insert(grains);
  if (has_air) {
    const auto rows = dem->rows();
    for (std::size_t n = 0; n < rows.count; ++n) {
      double* action = rows.drag_relaxation + 4 * n;
      action[0] = 0.3, action[1] = -0.2, action[2] = 0.1;
      action[3] = 3e-3 / rows.radius(n);
    }
    dem->drag_relaxation_changed();
  }
  return dem;
}

}  // namespace

TEST_CASE("grains moved two rows at a time shall move by the bits of those moved one by one") {
  // Of one watch: nobody but the flyer makes several steps at once.
  constexpr std::int64_t k_steps = 7;
  for (const bool has_air : {false, true}) {
    CAPTURE(has_air);
    auto in_twos = hundred_pairs(false, has_air);
    auto one_by_one = hundred_pairs(true, has_air);
    Stepper(*in_twos).step(k_steps);
    const auto slept = one_by_one->report().free_flight_steps;
    Stepper(*one_by_one).step(k_steps);
    one_by_one->synchronise();
    in_twos->synchronise();
    CHECK(in_twos->report().free_flight_steps == 0);
    CHECK(one_by_one->report().free_flight_steps >= slept + k_steps);
    for (std::int64_t id = 0; id < 201; ++id) {
      CAPTURE(id);
      const GrainState a = grain(*in_twos, id);
      const GrainState b = grain(*one_by_one, id + 1);
      CHECK(a.radius == b.radius);
      for (const auto& [x, y] : {std::pair{a.position, b.position},
                                 {a.velocity, b.velocity},
                                 {a.rotation, b.rotation}}) {
        CHECK(x.x == y.x);
        CHECK(x.y == y.y);
        CHECK(x.z == y.z);
      }
    }
    // Contacts have acted: a grain alone keeps its spin.
    CHECK(in_twos->report().largest_overlap > 1e-3);
  }
}

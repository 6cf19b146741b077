// SPDX-License-Identifier: Apache-2.0
#include "contact/standing.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using namespace dust::test;

namespace {

constexpr int k_pairs = 75;  // more than a batch, and no multiple of eight

/// Two grains that collide off centre, spinning; each pair a little later and faster than the last.
std::vector<NewGrain> pair(int n) {
  const double late = 1e-7 * n;
  const Vec3 place = 2e-3 * Vec3{1.0 * (n % 5), 1.0 * (n / 5 % 5), 1.0 * (n / 25)};
  NewGrain a{.diameter = 0.5e-3};
  a.position = place - Vec3{0.225e-3 + late, 0, 0};
  a.velocity = {0.05 + 0.001 * n, 0.02, -0.01};
  a.rotation = {30, -80, 50};
  NewGrain b{.diameter = 0.5e-3};
  b.position = place + Vec3{0.225e-3 + late, 0.2e-3, 0};
  b.velocity = {-0.05, 0.01, 0.03};
  return {a, b};
}

/// Collisions of all the pairs given, in one world.
struct World {
  std::unique_ptr<dust::particles::Dem> dem;
  std::int64_t most_contacts = 0;

  World(const DemRig::Choice& contact, const DemRig::Choice& cohesion,
        const std::vector<NewGrain>& grains) {
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.laws_of(sand, sand, contact, {"epsd2", {{"friction", 0.2}}}, cohesion);
    rig.diameters = {0.5e-3};
    rig.setup.gravity = {0, 0, 0};
    dem = rig.make();
    dem->insert(grains);
    Stepper stepper(*dem);
    for (int n = 0; n < 400; ++n) {
      stepper.step();
      most_contacts = std::max(most_contacts, dem->report().contacts);
      if (n % 10 == 9) dem->synchronise();  // so that watches begin amid the collisions
    }
  }
};

}  // namespace

TEST_CASE("a pair that has parted shall feel nothing and remember nothing") {
  using dust::contact::BatchColumns;
  constexpr std::size_t k_count = 24;
  constexpr std::size_t k_stride = 8;
  std::vector<double> block(k_count * k_stride);
  for (std::size_t n = 0; n < block.size(); ++n) block[n] = 1.0 + static_cast<double>(n);
  std::vector<std::uint8_t> is_touching(k_count, 1);
  is_touching[0] = is_touching[13] = is_touching[23] = 0;
  BatchColumns columns;
  dust::contact::rows_to_columns(block.data(), k_count, k_stride);
  columns.keep_history_at(block.data(), k_count);
  for (int c = 0; c < BatchColumns::first_history; ++c) {
    std::fill_n(columns.column(c), k_count, 7.0);
  }
  dust::contact::mask_separated(is_touching.data(), k_count, columns);
  dust::contact::clear_separated(is_touching.data(), k_count, k_stride, columns);
  dust::contact::columns_to_rows(block.data(), k_count, k_stride);
  for (std::size_t q = 0; q < k_count; ++q) {
    CAPTURE(q);
    const bool has_touched = is_touching[q] != 0;
    for (const int c : {BatchColumns::overlap, BatchColumns::velocity_y, BatchColumns::force_x,
                        BatchColumns::force_z, BatchColumns::torque_i_y, BatchColumns::torque_j_z,
                        BatchColumns::torque_y}) {
      CHECK(columns.column(c)[q] == (has_touched ? 7.0 : 0.0));
    }
    for (std::size_t h = 0; h < k_stride; ++h) {
      CHECK(block[q * k_stride + h] ==
            (has_touched ? 1.0 + static_cast<double>(q * k_stride + h) : 0.0));
    }
  }
}

TEST_CASE("a collision among many shall be the same to the last bit as by itself") {
  const DemRig::Choice hertz{"hertz_mindlin", {{"restitution", 0.7}, {"friction", 0.4}}};
  const DemRig::Choice hooke{
      "hooke", {{"restitution", 0.7}, {"friction", 0.4}, {"normal_stiffness", 2000.0}}};
  const DemRig::Choice sjkr{"sjkr", {{"energy_density", 2e4}}};
  for (const auto& [contact, cohesion] :
       {std::pair{hertz, DemRig::Choice{}}, {hooke, DemRig::Choice{}}, {hertz, sjkr}}) {
    CAPTURE(contact.name);
    CAPTURE(cohesion.name);
    std::vector<NewGrain> all;
    for (int n = 0; n < k_pairs; ++n) {
      for (const NewGrain& g : pair(n)) all.push_back(g);
    }
    World together(contact, cohesion, all);
    REQUIRE(together.most_contacts > k_pairs / 2);
    CHECK(together.dem->report().contacts == 0);
    for (int n = 0; n < k_pairs; ++n) {
      CAPTURE(n);
      World alone(contact, cohesion, pair(n));
      REQUIRE(alone.most_contacts == 1);
      for (int side = 0; side < 2; ++side) {
        const GrainState a = grain(*together.dem, 2 * n + side);
        const GrainState b = grain(*alone.dem, side);
        const auto same = [](const Vec3& x, const Vec3& y) {
          return x.x == y.x && x.y == y.y && x.z == y.z;
        };
        // When a grain flies, and many steps are made at once, depends on the fastest of all.
        CHECK(norm(a.position - b.position) < 1e-15);
        CHECK(same(a.velocity, b.velocity));
        CHECK(same(a.rotation, b.rotation));
        CHECK(norm(b.velocity - pair(n)[static_cast<std::size_t>(side)].velocity) > 0.01);
      }
    }
  }
}

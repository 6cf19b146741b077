// SPDX-License-Identifier: Apache-2.0
#include "support/dem_rig.hpp"

#include "dust/sdk/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using namespace dust::test;

TEST_CASE("a contact across tiles shall act once on each of its grains") {
  // 14^3 grains of 1 mm, 0.5 % closer than touch: six tiles of 512 rows, hundreds of contacts
  // between them. No gravity, so that the forces are those of the contacts.
  DemRig rig;
  const int sand = rig.material(2650, 5e6, 0.3);
  rig.law(sand, sand, 0.8, 0.5, 0.3);
  rig.diameters = {1e-3};
  rig.setup.gravity = {0, 0, 0};
  auto dem = rig.make();
  const dust::sdk::Random random(7, 1);
  std::vector<NewGrain> grains;
  std::uint64_t n = 0;
  for (int i = 0; i < 14; ++i) {
    for (int j = 0; j < 14; ++j) {
      for (int k = 0; k < 14; ++k, ++n) {
        const Vec3 u{random.uniform(n, 0) - 0.5, random.uniform(n, 1) - 0.5,
                     random.uniform(n, 2) - 0.5};
        NewGrain g{.diameter = 1e-3};
        g.position = 0.995e-3 * Vec3{1.0 * i, 1.0 * j, 1.0 * k} + 4e-6 * u;
        g.velocity = 0.05 * u;
        grains.push_back(g);
      }
    }
  }
  dem->insert(grains);
  // The second step has histories to hand on.
  for (int step = 0; step < 2; ++step) {
    dem->neighbours();
    const auto records = dem->contacts(step * dem->coarse_step());
    const auto rows = dem->rows().count;
    REQUIRE(rows == grains.size());
    std::vector<double> sum(4 * rows, 0.0);
    std::size_t across = 0;
    double most = 0.0;
    for (const auto& r : records) {
      for (std::size_t d = 0; d < 3; ++d) {
        sum[4 * static_cast<std::size_t>(r.row_i) + d] += r.force[static_cast<int>(d)];
        sum[4 * static_cast<std::size_t>(r.row_j) + d] -= r.force[static_cast<int>(d)];
        most = std::max(most, std::abs(r.force[static_cast<int>(d)]));
      }
      across += r.row_i / 512 != r.row_j / 512 ? 1 : 0;
    }
    REQUIRE(across > 300);
    dem->contact(step * dem->coarse_step(), true);
    dem->force();
    dem->integrate();
    dem->advance_fine();
    CHECK(dem->report().contacts == static_cast<std::int64_t>(records.size()));
    const auto force = dem->last_force();
    double worst = 0.0;
    Vec3 total{0, 0, 0};
    for (std::size_t q = 0; q < force.size(); ++q) {
      if (q % 4 == 3) continue;
      worst = std::max(worst, std::abs(force[q] - sum[q]));
      total[static_cast<int>(q % 4)] += force[q];
    }
    // Sums of a dozen numbers in another order.
    CHECK(worst < 1e-13 * most);
    CHECK(norm(total) < 1e-11 * most);
  }
}

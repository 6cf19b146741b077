// SPDX-License-Identifier: Apache-2.0
#include "support/dem_rig.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using namespace dust::test;

namespace {

using Pairs = std::set<std::pair<std::int64_t, std::int64_t>>;

/// All pairs closer than `share` of the sum of their radii beyond touch.
Pairs brute_force(dust::particles::Dem& dem, Vec3 period, double margin) {
  Pairs out;
  const auto rows = dem.rows();
  for (std::size_t i = 0; i < rows.count; ++i) {
    for (std::size_t j = i + 1; j < rows.count; ++j) {
      double sum = 0.0;
      for (int d = 0; d < 3; ++d) {
        double x = rows.position[4 * i + static_cast<std::size_t>(d)] -
                   rows.position[4 * j + static_cast<std::size_t>(d)];
        if (period[d] > 0.0) x -= period[d] * std::round(x / period[d]);
        sum += x * x;
      }
      const double reach = rows.radius(i) + rows.radius(j) + margin;
      if (sum < reach * reach) {
        out.emplace(std::min(rows.id[i], rows.id[j]), std::max(rows.id[i], rows.id[j]));
      }
    }
  }
  return out;
}

void check_lists(DemRig& rig, const std::vector<NewGrain>& grains, Vec3 period,
                 double largest_factor) {
  auto dem = rig.make();
  dem->insert(grains);
  dem->neighbours();
  const auto listed = dem->listed_pairs();
  const Pairs set(listed.begin(), listed.end());
  CHECK(set.size() == listed.size());
  const Pairs touching = brute_force(*dem, period, 0.0);
  REQUIRE(touching.size() > 50);
  CHECK(std::includes(set.begin(), set.end(), touching.begin(), touching.end()));
  // Nothing far away is listed: resting grains reach their allowances of three tenths of the
  // largest diameter each, no more.
  const Pairs reach = brute_force(*dem, period, 0.6 * rig.diameters.back() * (1 + 1e-9));
  CHECK(std::includes(reach.begin(), reach.end(), set.begin(), set.end()));
  CHECK(static_cast<double>(set.size()) < largest_factor * static_cast<double>(touching.size()));
}

}  // namespace

TEST_CASE("the neighbour lists shall hold what brute force finds among sand and dust") {
  for (const bool is_periodic : {false, true}) {
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.law(sand, sand, 0.9, 0.5);
    rig.diameters = {10e-6, 80e-6, 300e-6, 600e-6};
    rig.setup.domain.min = {0, 0, 0};
    rig.setup.domain.max = {4e-3, 3e-3, 3e-3};
    Vec3 period;
    if (is_periodic) {
      rig.periodic(0);
      rig.periodic(1);
      period = {4e-3, 3e-3, 0};
    }
    const dust::sdk::Random random(7, 1);
    std::vector<NewGrain> grains;
    for (std::uint64_t n = 0; n < 900; ++n) {
      const Vec3 u{random.uniform(n, 0), random.uniform(n, 1), random.uniform(n, 2)};
      NewGrain g{.position = {4e-3 * u.x, 3e-3 * u.y, 3e-3 * u.z},
                 .diameter = n < 300 ? 600e-6 : 300e-6};
      if (n >= 500) g.diameter = 80e-6;
      if (n >= 600) {
        // A dense pocket of dust in a corner, across the periodic sides.
        g.diameter = 10e-6;
        g.position = {60e-6 * u.x, 60e-6 * u.y, 60e-6 * u.z};
      }
      grains.push_back(g);
    }
    check_lists(rig, grains, period, 60.0);
  }
}

TEST_CASE("a pocket of dust shall not list the dust beyond its next neighbours") {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.5);
  rig.diameters = {10e-6, 600e-6};
  std::vector<NewGrain> grains;
  for (int n = 0; n < 1000; ++n) {
    grains.push_back({.position = {1e-5 * (n % 10), 1e-5 * (n / 10 % 10), 1e-5 * (n / 100)},
                      .diameter = 10.01e-6});
  }
  grains.push_back({.position = {-400e-6, 0, 0}, .diameter = 600e-6});
  auto dem = rig.make();
  dem->insert(grains);
  dem->neighbours();
  // A cube has 2700 touching pairs and half a million pairs in all; within two and a half diameters
  // there are some 60 per grain.
  CHECK(dem->listed_pairs().size() >= 2700);
  CHECK(dem->listed_pairs().size() < 60000);
}

/// Grains of 0.6 mm, each tenth one of 0.15 mm if there are two sizes, in a periodic box or one of
/// walls, every one with its own velocity.
void look_for_missed_contacts(bool is_periodic, bool has_two_sizes) {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.5);
  rig.diameters = {600e-6};
  if (has_two_sizes) rig.diameters = {150e-6, 600e-6};
  rig.setup.domain.min = {0, 0, 0};
  rig.setup.domain.max = {8e-3, 8e-3, 8e-3};
  for (int d = 0; d < 3 && is_periodic; ++d) rig.periodic(d);
  for (int s = 0; s < 6 && !is_periodic; ++s) rig.wall(s, sand);
  const dust::sdk::Random random(3, 1);
  std::vector<NewGrain> grains;
  for (std::uint64_t n = 0; n < 343; ++n) {
    const Vec3 cell{static_cast<double>(n % 7), static_cast<double>(n / 7 % 7),
                    static_cast<double>(n / 49)};
    grains.push_back({.position = 1.1e-3 * cell + Vec3{4e-4, 4e-4, 4e-4},
                      .velocity = Vec3{random.uniform(n, 0) - 0.5, random.uniform(n, 1) - 0.5,
                                       random.uniform(n, 2) - 0.5},
                      .diameter = has_two_sizes && n % 10 == 0 ? 150e-6 : 600e-6});
  }
  auto dem = rig.make();
  dem->insert(grains);
  Stepper stepper(*dem);
  const Vec3 period = is_periodic ? Vec3{8e-3, 8e-3, 8e-3} : Vec3{};
  std::size_t seen = 0;
  for (int n = 0; n < 400; ++n) {
    stepper.step(4);
    dem->neighbours();
    const auto listed = dem->listed_pairs();
    const Pairs set(listed.begin(), listed.end());
    const Pairs touching = brute_force(*dem, period, 0.0);
    seen += touching.size();
    REQUIRE(std::includes(set.begin(), set.end(), touching.begin(), touching.end()));
  }
  CHECK(seen > 100);
  CHECK(dem->rows().count == 343);
  CHECK(dem->report().missed_contact_onsets == 0);
  CHECK(dem->report().rebuilds > 5);
  CHECK(dem->report().rebuilds < 200);
}

TEST_CASE("grains without a law between them shall be told, even where there is one law alone") {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  const int coal = rig.material(1500, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.5);
  rig.diameters = {600e-6};
  rig.setup.domain.min = {0, 0, 0};
  rig.setup.domain.max = {8e-3, 8e-3, 8e-3};
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{
      {.position = {4e-3, 4e-3, 4e-3}, .diameter = 600e-6, .material = sand},
      {.position = {4.65e-3, 4e-3, 4e-3}, .diameter = 600e-6, .material = coal}});
  CHECK_THROWS_AS(dem->neighbours(), dust::sdk::ModelError);
}

TEST_CASE("no contact shall be missed where a few fast grains run through a crowd at rest") {
  for (const auto& [is_periodic, has_two_sizes] :
       {std::pair{true, false}, {false, false}, {true, true}, {false, true}}) {
    CAPTURE(is_periodic);
    CAPTURE(has_two_sizes);
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.law(sand, sand, 1.0, 0.0);
    rig.diameters = {600e-6};
    if (has_two_sizes) rig.diameters = {150e-6, 600e-6};
    const double pitch = 6.48e-4;
    // Walls out of the reach of grains at rest.
    const double gap = is_periodic ? 0.0 : 2e-4;
    const double edge = 10 * pitch + gap;
    rig.setup.domain.min = {-gap, -gap, -gap};
    rig.setup.domain.max = {edge, edge, edge};
    for (int d = 0; d < 3 && is_periodic; ++d) rig.periodic(d);
    for (int s = 0; s < 6 && !is_periodic; ++s) rig.wall(s, sand);
    const dust::sdk::Random random(5, 1);
    std::vector<NewGrain> grains;
    // So near each other that allowances are narrow, with gaps to fly through.
    for (std::uint64_t n = 0; n < 1000; ++n) {
      if (random.uniform(n, 3) < 0.25) continue;
      const Vec3 cell{n % 10 + 0.5, n / 10 % 10 + 0.5, static_cast<double>(n / 100) + 0.5};
      const Vec3 u{random.uniform(n, 0) - 0.5, random.uniform(n, 1) - 0.5,
                   random.uniform(n, 2) - 0.5};
      grains.push_back({.position = pitch * cell,
                        .velocity = n % 50 == 7 ? 4.0 * u : Vec3{},
                        .diameter = has_two_sizes && n % 12 == 5 ? 150e-6 : 600e-6});
    }
    const std::size_t count = grains.size();
    auto dem = rig.make();
    dem->insert(grains);
    Stepper stepper(*dem);
    const Vec3 period = is_periodic ? rig.setup.domain.max : Vec3{};
    std::size_t unlisted = 0;
    for (int n = 0; n < 600; ++n) {
      stepper.step(4);
      dem->neighbours();
      const auto listed = dem->listed_pairs();
      const Pairs set(listed.begin(), listed.end());
      for (const auto& pair : brute_force(*dem, period, 0.0)) unlisted += 1 - set.count(pair);
    }
    CHECK(unlisted == 0);
    // Dust between grains that collide is kicked out of its allowance in a step, and counted.
    CHECK(dem->report().missed_contact_onsets == 0);
    CHECK(dem->rows().count == count);
    CHECK(dem->report().list_repairs > 20);
    CHECK(dem->report().list_repairs > dem->report().rebuilds);
  }
}

TEST_CASE("no contact shall be missed between rebuilds in a fast dilute flow") {
  for (const bool is_periodic : {true, false}) {
    for (const bool has_two_sizes : {false, true}) {
      CAPTURE(is_periodic);
      CAPTURE(has_two_sizes);
      look_for_missed_contacts(is_periodic, has_two_sizes);
    }
  }
}

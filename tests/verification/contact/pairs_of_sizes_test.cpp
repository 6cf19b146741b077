// SPDX-License-Identifier: Apache-2.0
// Collisions of grains of all sizes, stepped at one rate or at several: restitution, momentum and
// the energy of an elastic gas.
#include "dust/sdk/random.hpp"
#include "support/approx.hpp"
#include "verification/contact/gas_energy.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>
#include <vector>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_density = 2650.0;
constexpr double k_young = 10e6;
constexpr double k_poisson = 0.3;
/// A grain of this radius far away sets the border of the coarse rate: an eighth of it.
constexpr double k_largest = 1.2e-3;
constexpr double k_speed = 0.5;

struct Pair {
  double radius_i, radius_j;
  double weight_i = 1.0, weight_j = 1.0;
};

struct Collision {
  double restitution = 0.0;
  double momentum = 0.0;  ///< change of the weighted momentum over the momentum exchanged
};

/// Head on, i against j at rest, beside the largest grain.
Collision collide(const Pair& p, double restitution, bool is_single) {
  DemRig rig;
  const int sand = rig.material(k_density, k_young, k_poisson);
  rig.law(sand, sand, restitution, 0.3);
  rig.diameters = {2.0 * p.radius_i, 2.0 * p.radius_j, 2.0 * k_largest};
  std::sort(rig.diameters.begin(), rig.diameters.end());
  rig.diameters.erase(std::unique(rig.diameters.begin(), rig.diameters.end()), rig.diameters.end());
  rig.setup.time.rates_single = is_single;
  rig.setup.time.expected_speed = k_speed;
  const double ri = p.radius_i;
  const double rj = p.radius_j;
  const double volume = 4.0 / 3.0 * 3.14159265358979324;
  const double mi = k_density * volume * ri * ri * ri;
  const double mj = k_density * volume * rj * rj * rj;
  // A side feels the force times its share: that of the lighter weight over its own.
  const double share_i = std::min(1.0, p.weight_j / p.weight_i);
  const double share_j = std::min(1.0, p.weight_i / p.weight_j);
  const double duration = rig.laws[0].contact->collision_time(
      ri * rj / (ri + rj), 1.0 / (share_i / mi + share_j / mj), k_speed);
  auto dem = rig.make();
  const double gap = 0.05 * std::min(ri, rj);
  const Vec3 along = Vec3{2.0, 3.0, 6.0} / 7.0;
  dem->insert(
      std::vector<NewGrain>{{.position = (ri + rj + gap) * along,
                             .velocity = -k_speed * along,
                             .diameter = 2.0 * ri,
                             .weight = p.weight_i},
                            {.position = {0, 0, 0}, .diameter = 2.0 * rj, .weight = p.weight_j},
                            {.position = {0.5, 0.5, 0.5}, .diameter = 2.0 * k_largest}});
  Stepper stepper(*dem);
  const double end = 3.0 * duration + gap / k_speed;
  while (stepper.time() < end) stepper.step();
  const GrainState i = grain(*dem, 0);
  const GrainState j = grain(*dem, 1);
  const double wi = p.weight_i * mi;
  const double wj = p.weight_j * mj;
  const Vec3 before = -wi * k_speed * along;
  const Vec3 after = wi * i.velocity + wj * j.velocity;
  return {dot(i.velocity - j.velocity, along) / k_speed, norm(after - before) / norm(before)};
}

}  // namespace

TEST_CASE("a pair of any two sizes shall realise its restitution at several rates") {
  // 15 steps per contact: the discretisation itself is within 0.01 (realised_test.cpp).
  constexpr double k_realised = 0.01;
  constexpr double k_rounding = 1e-12;
  double worst = 0.0;
  const auto check = [&](const Pair& p) {
    for (const double e : {1.0, 0.9, 0.5}) {
      const Collision c = collide(p, e, false);
      CAPTURE(p.radius_i);
      CAPTURE(p.radius_j);
      CAPTURE(p.weight_i);
      CAPTURE(p.weight_j);
      CAPTURE(e);
      worst = std::max(worst, std::abs(c.restitution - e));
      CHECK(std::abs(c.restitution - e) < k_realised);
      CHECK(c.momentum < k_rounding);
    }
  };
  // The border lies at 0.15 mm. Both sides of it, ratios from 1:1 to 1:60.
  const double radii[] = {1.2e-3, 0.5e-3, 0.22e-3, 0.155e-3, 0.145e-3, 0.1e-3, 0.05e-3, 0.02e-3};
  for (const double ri : radii) {
    for (const double rj : radii) {
      if (rj <= ri) check({ri, rj});
      if (rj < ri) check({rj, ri});
    }
  }
  for (const double wj : {0.05, 1.0, 8.0}) {
    for (const double wi : {0.05, 1.0, 8.0}) {
      if (wi == wj) continue;
      for (const Pair& p : {Pair{0.155e-3, 0.145e-3}, Pair{0.155e-3, 0.16e-3},
                            Pair{0.145e-3, 0.14e-3}, Pair{1.2e-3, 0.1e-3}}) {
        check({p.radius_i, p.radius_j, wi, wj});
      }
    }
  }
  MESSAGE("largest error of a restitution " << worst);
}

namespace {

/// A frictionless gas of grains on both sides of the border, beside some large ones.
class MixedGas {
 public:
  MixedGas(double restitution, bool is_single) {
    DemRig rig;
    const int sand = rig.material(k_density, k_young, k_poisson);
    rig.law(sand, sand, restitution, 0.0);
    rig.setup.domain.min = {0, 0, 0};
    rig.setup.domain.max = {k_edge, k_edge, k_edge};
    rig.setup.time.rates_single = is_single;
    rig.setup.time.expected_speed = 1.5;
    for (int d = 0; d < 3; ++d) rig.periodic(d);
    const dust::sdk::Random random(11, 3);
    std::vector<NewGrain> grains;
    // Three large ones, the rest on a lattice between them.
    const Vec3 large[3] = {
        {1.5e-3, 1.5e-3, 1.5e-3}, {4.5e-3, 4.5e-3, 1.5e-3}, {1.5e-3, 4.5e-3, 4.5e-3}};
    for (const Vec3& p : large) grains.push_back({.position = p, .diameter = 2.0 * k_largest});
    constexpr int k_side = 12;
    for (std::uint64_t n = 0; n < k_side * k_side * k_side; ++n) {
      const double pitch = k_edge / k_side;
      const Vec3 p{pitch * (static_cast<double>(n % k_side) + 0.5),
                   pitch * (static_cast<double>(n / k_side % k_side) + 0.5),
                   pitch * (static_cast<double>(n / (k_side * k_side)) + 0.5)};
      constexpr double k_diameters[4] = {0.26e-3, 0.34e-3, 0.31e-3, 0.12e-3};
      const double diameter = k_diameters[n % 4];
      bool is_free = true;
      for (const Vec3& q : large) {
        is_free = is_free && norm(p - q) > k_largest + 0.5 * diameter + 2e-5;
      }
      if (!is_free) continue;
      grains.push_back({.position = p,
                        .velocity = {random.uniform(n, 0) - 0.5, random.uniform(n, 1) - 0.5,
                                     random.uniform(n, 2) - 0.5},
                        .diameter = diameter});
    }
    for (const NewGrain& g : grains) rig.diameters.push_back(g.diameter);
    std::sort(rig.diameters.begin(), rig.diameters.end());
    rig.diameters.erase(std::unique(rig.diameters.begin(), rig.diameters.end()),
                        rig.diameters.end());
    dem_ = rig.make();
    dem_->insert(grains);
    stepper_ = std::make_unique<Stepper>(*dem_);
    start_ = energy();
  }
  /// Until `time` [s].
  void run(double time) {
    while (stepper_->time() < time) stepper_->step();
  }
  /// Kinetic energy and that of the springs, in its value at the start: mean over some instants.
  double energy_share() {
    double sum = 0.0;
    constexpr int k_samples = 20;
    for (int n = 0; n < k_samples; ++n) {
      stepper_->step(8);
      sum += energy();
    }
    return sum / k_samples / start_;
  }
  [[nodiscard]] double time() const { return stepper_->time(); }
  double energy() {
    return energy_of_gas(*dem_, k_edge, k_young / (1.0 - k_poisson * k_poisson) / 2.0,
                         [&](std::int64_t i, std::int64_t j, double overlap) {
                           if (!(overlap > 0.0)) {
                             touching_.erase({i, j});
                           } else if (touching_.insert({i, j}).second) {
                             ++begun_;
                           }
                         });
  }
  [[nodiscard]] std::int64_t collisions_seen() const { return begun_; }

 private:
  static constexpr double k_edge = 6e-3;
  std::unique_ptr<dust::particles::Dem> dem_;
  std::unique_ptr<Stepper> stepper_;
  double start_ = 0.0;
  std::set<std::pair<std::int64_t, std::int64_t>> touching_;
  std::int64_t begun_ = 0;
};

}  // namespace

TEST_CASE("an elastic gas of three sizes shall keep its energy at several rates") {
  constexpr double k_kept = 1e-3;
  MixedGas gas(1.0, false);
  // Looked at often enough to see nearly every contact begin; some 10,000 do.
  while (gas.collisions_seen() < 10000) {
    gas.run(gas.time() + 2e-5);
    gas.energy();
    REQUIRE(gas.time() < 0.2);
  }
  const double share = gas.energy_share();
  MESSAGE(gas.collisions_seen() << " collisions, energy " << 100.0 * (share - 1.0) << " % up");
  CHECK(std::abs(share - 1.0) < k_kept);
}

TEST_CASE("a dissipative gas shall cool at several rates as at one") {
  // 0.95; chaos parts the two runs, and a thousand grains with some ten collisions each leave a
  // scatter of some hundredths of the energy that is left.
  constexpr double k_scatter = 0.05;
  double left[2];
  for (const bool is_single : {false, true}) {
    MixedGas gas(0.95, is_single);
    gas.run(0.01);
    left[is_single ? 1 : 0] = gas.energy_share();
  }
  MESSAGE("energy left " << left[0] << " at several rates, " << left[1] << " at one");
  CHECK(left[0] == approx(left[1]).epsilon(k_scatter));
}

// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/search.hpp"

#include "base/periodic.hpp"

#include "dust/sdk/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace dust::particles;

namespace {

struct Flock {
  std::vector<double> position, velocity, skin;
  SearchInput in;

  /// `count` grains in a box of `size` [m], some ten times finer, with speeds up to `speed` [m/s].
  Flock(std::size_t count, const double (&size)[3], double speed) {
    const dust::sdk::Random random(11, 3);
    for (std::uint64_t n = 0; n < count; ++n) {
      for (std::uint64_t d = 0; d < 3; ++d) {
        position.push_back(size[d] * random.uniform(n, d));
        velocity.push_back(speed * (2.0 * random.uniform(n, 4 + d) - 1.0));
        skin.push_back(0.0);
      }
      position.push_back(n % 3 == 0 ? 30e-6 : 250e-6 + 50e-6 * random.uniform(n, 8));
      velocity.push_back(0.0);
      skin.push_back(n % 3 == 0 ? 20e-6 : 90e-6);
    }
    in.count = count;
    in.position = position.data();
    in.velocity = velocity.data();
    in.skin = skin.data();
    in.lifetime = 1e-4;
    in.range = 5e-6;
  }

  /// Closest distance [m] of two grains within the horizon, looked at in ten thousand instants.
  [[nodiscard]] double closest(std::size_t i, std::size_t j) const {
    double least = 1e9;
    for (int s = 0; s <= 10000; ++s) {
      double sum = 0.0;
      for (std::size_t d = 0; d < 3; ++d) {
        double x = position[4 * i + d] - position[4 * j + d] +
                   1e-4 * s * in.lifetime * (velocity[4 * i + d] - velocity[4 * j + d]);
        if (in.period[d] > 0.0) x = dust::base::nearest_image_of_any(x, in.period[d]);
        sum += x * x;
      }
      least = std::min(least, sum);
    }
    return std::sqrt(least);
  }
};

using Pairs = std::set<std::pair<std::int32_t, std::int32_t>>;

/// The pairs found, each of which has to be found once.
Pairs found(const SearchInput& in, std::size_t block) {
  Pairs set;
  std::size_t count = 0;
  for (const auto& pairs : search_pairs(in, block)) {
    count += pairs.size();
    for (const auto& [i, j] : pairs) set.emplace(std::min(i, j), std::max(i, j));
  }
  CHECK(set.size() == count);
  return set;
}

void check(const Flock& flock, std::size_t at_least) {
  const Pairs set = found(flock.in, 16);
  CHECK(set == found(flock.in, 1024));
  std::size_t expected = 0;
  for (std::size_t i = 0; i < flock.in.count; ++i) {
    for (std::size_t j = i + 1; j < flock.in.count; ++j) {
      const double reach = flock.position[4 * i + 3] + flock.position[4 * j + 3] +
                           flock.skin[4 * i + 3] + flock.skin[4 * j + 3] + flock.in.range;
      // Most pairs are too far apart for a look at every instant.
      const double fast = 4.0 * flock.in.lifetime;
      double far = 0.0;
      for (std::size_t d = 0; d < 3; ++d) {
        double x = flock.position[4 * i + d] - flock.position[4 * j + d];
        if (flock.in.period[d] > 0.0) {
          x -= flock.in.period[d] * std::round(x / flock.in.period[d]);
        }
        far += x * x;
      }
      if (std::sqrt(far) > reach + 2.0 * fast) {
        CHECK_FALSE(set.contains({static_cast<int>(i), static_cast<int>(j)}));
        continue;
      }
      const double closest = flock.closest(i, j);
      // Between two instants a pair comes nearer by a hundredth of a micrometre at most.
      if (std::abs(closest - reach) < 2e-8) continue;
      const bool is_near = closest < reach;
      expected += is_near ? 1 : 0;
      CHECK(set.contains({static_cast<int>(i), static_cast<int>(j)}) == is_near);
    }
  }
  CHECK(expected > at_least);
}

}  // namespace

TEST_CASE("the search shall find what comes near in the time asked for, and nothing else") {
  SUBCASE("a crowd, in a table of cells") { check({300, {4e-3, 3e-3, 3e-3}, 2.0}, 500); }
  SUBCASE("few grains far apart, most cells empty") {
    Flock flock(200, {0.3, 0.02, 0.3}, 2.0);
    // Neighbours, so that something is found.
    for (std::size_t n = 1; n < 200; n += 2) {
      for (std::size_t d = 0; d < 3; ++d) {
        flock.position[4 * n + d] = flock.position[4 * (n - 1) + d] + 300e-6;
      }
    }
    check(flock, 30);
  }
  SUBCASE("periodic, one direction narrower than three cells") {
    Flock flock(250, {4e-3, 1.6e-3, 4e-3}, 2.0);
    flock.in.period[0] = 4e-3;
    flock.in.period[1] = 1.6e-3;
    check(flock, 500);
  }
  SUBCASE("periodic, with grains that have left the period and have not been put back") {
    Flock flock(400, {4e-3, 4e-3, 4e-3}, 2.0);
    for (std::size_t d = 0; d < 3; ++d) {
      flock.in.period[d] = 4e-3;
      for (std::size_t n = 0; n < 400; ++n) {
        double& x = flock.position[4 * n + d];
        if (x > 3.7e-3) x -= 4e-3;
        if (n % 2 == 0 && x >= 0.0 && x < 0.3e-3) x += 4e-3;
      }
    }
    check(flock, 500);
  }
  SUBCASE("at rest") { check({300, {4e-3, 3e-3, 3e-3}, 0.0}, 500); }
}

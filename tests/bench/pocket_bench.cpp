// SPDX-License-Identifier: Apache-2.0
// Cost per grain of new neighbour lists: a bed of one size, and a pocket of 20,000 grains of 10 um
// among 10,000 of 0.5 mm. One thread.
#include "support/dem_rig.hpp"

#include "dust/sdk/random.hpp"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

using dust::particles::Dem;
using dust::particles::NewGrain;
using dust::sdk::Vec3;
using namespace dust::test;

namespace {

constexpr double k_sand = 0.5e-3;
constexpr double k_dust = 10e-6;
constexpr int k_edge = 22;  // grains of sand along the base of the box

/// Grains on a jittered lattice in a cube of `edge` grains, as many as `count`.
void add_lattice(std::vector<NewGrain>& grains, std::size_t count, double diameter, double spacing,
                 Vec3 corner, int edge, std::uint64_t seed) {
  const dust::sdk::Random random(seed, 1);
  for (std::size_t n = 0; n < count; ++n) {
    const auto k = static_cast<int>(n);
    const Vec3 jitter{random.uniform(n, 0), random.uniform(n, 1), random.uniform(n, 2)};
    NewGrain g{.diameter = diameter};
    g.position = corner +
                 spacing * Vec3{k % edge + 0.5, k / edge % edge + 0.5, k / edge / edge + 0.5} +
                 0.5 * (spacing - diameter) * (2.0 * jitter - Vec3{1, 1, 1});
    g.velocity = 0.01 * (2.0 * Vec3{jitter.y, jitter.z, jitter.x} - Vec3{1, 1, 1});
    grains.push_back(g);
  }
}

/// Nanoseconds per grain of a rebuild and the first watch after it: the best of many.
double rebuild_cost(bool has_pocket) {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.5, 0.3);
  rig.diameters = has_pocket ? std::vector<double>{k_dust, k_sand} : std::vector<double>{k_sand};
  rig.setup.time.expected_speed = 0.1;
  const double spacing = 1.04 * k_sand;
  rig.setup.domain.min = {0, 0, -2 * k_sand};
  rig.setup.domain.max = {k_edge * spacing, k_edge * spacing, 0.1};
  auto dem = rig.make();
  std::vector<NewGrain> grains;
  if (has_pocket) {
    add_lattice(grains, 10000, k_sand, spacing, {0, 0, 0}, k_edge, 1);
    // The pocket: 1 mm wide, in the middle; the sand in it makes room.
    const Vec3 corner = spacing * Vec3{10, 10, 10};
    std::erase_if(grains, [&](const NewGrain& g) {
      const Vec3 d = g.position - corner;
      const double far = 1e-3 + 0.5 * k_sand;
      return std::min({d.x, d.y, d.z}) > -0.5 * k_sand && std::max({d.x, d.y, d.z}) < far;
    });
    add_lattice(grains, 20000, k_dust, 1e-3 / 28, corner, 28, 2);
  } else {
    add_lattice(grains, 30000, k_sand, spacing, {0, 0, 0}, k_edge, 1);
  }
  dem->insert(grains);
  double best = 1e30;
  for (int n = 0; n < 20; ++n) {
    // A grain more asks for new lists; it stands apart from all others.
    NewGrain one{.diameter = k_sand};
    one.position = {k_sand, k_sand, 0.09 - 2 * k_sand * n};
    dem->insert({&one, 1});
    const auto start = std::chrono::steady_clock::now();
    dem->neighbours();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    dem->step_tiles(0.0);
    dem->advance_fine();
    best = std::min(best, spent.count());
  }
  const auto count = static_cast<double>(dem->rows().count);
  std::printf("%-42s %6.0f grains  %7.1f ns per grain\n",
              has_pocket ? "20,000 of 10 um in a pocket of the sand" : "sand of 0.5 mm", count,
              1e9 * best / count);
  return best / count;
}

}  // namespace

int main() {
  oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const double sand = rebuild_cost(false);
  const double pocket = rebuild_cost(true);
  std::printf("ratio %.2f\n", pocket / sand);
  return 0;
}

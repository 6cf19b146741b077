// SPDX-License-Identifier: Apache-2.0
// Cost per grain of new neighbour lists: a bed of one size, a pocket of 20,000 grains of 10 um
// among 10,000 of 0.5 mm, and a bed on a mesh of many parts. One thread.
#include "dust/sdk/random.hpp"
#include "unit/bodies/meshes.hpp"
#include "verification/walls/wall_rig.hpp"

#include <oneapi/tbb/global_control.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

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

/// A floor of so many pegs along each side, all of one mesh: a part each.
void add_pegs(WallRig& rig, int along, double width) {
  Corners pegs;
  const double pitch = width / along;
  for (int n = 0; n < along * along; ++n) {
    const Vec3 corner{pitch * (n % along), pitch * (n / along), -2 * k_sand};
    const Corners peg = box_mesh(corner, corner + Vec3{0.9 * pitch, 0.9 * pitch, 1.9 * k_sand});
    pegs.insert(pegs.end(), peg.begin(), peg.end());
  }
  const auto file = std::filesystem::temp_directory_path() /
                    ("pocket_bench_" + std::to_string(::getpid()) + ".stl");
  rig.body("mesh", {{"file", write_text_stl(file, pegs)}, {"unit", 1.0}});
  std::filesystem::remove(file);
}

/// Nanoseconds per grain of a rebuild and the first watch after it: the best of many.
double rebuild_cost(const std::string& name, bool has_pocket, int pegs_along = 0) {
  WallRig rig(0.9, 0.5, k_sand, 0.3);
  if (has_pocket) rig.diameters = {k_dust, k_sand};
  rig.setup.time.expected_speed = 0.1;
  const double spacing = 1.04 * k_sand;
  if (pegs_along > 0) add_pegs(rig, pegs_along, k_edge * spacing);
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
  std::printf("%-42s %6.0f grains  %7.1f ns per grain\n", name.c_str(), count, 1e9 * best / count);
  return best / count;
}

}  // namespace

int main() {
  oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const double sand = rebuild_cost("sand of 0.5 mm", false);
  const double pocket = rebuild_cost("20,000 of 10 um in a pocket of the sand", true);
  std::printf("ratio %.2f\n", pocket / sand);
  const double peg = rebuild_cost("sand on a mesh of one part", false, 1);
  const double pegs = rebuild_cost("sand on a mesh of 400 parts", false, 20);
  std::printf("ratio %.2f\n", pegs / peg);
  return 0;
}

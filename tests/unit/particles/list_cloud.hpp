// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/closest_approach.hpp"
#include "dust/sdk/random.hpp"
#include "particles/neighbours/list_scene.hpp"
#include "particles/store/particle_store.hpp"
#include "support/dem_rig.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dust::test {

/// Particles at random places of a periodic box, coarse ones first, for tests of pair lists.
class ListCloud {
 public:
  static constexpr double k_box = 0.02;       // [m]
  static constexpr double k_diameter = 1e-3;  // [m] of coarse ones; fine ones have a tenth
  static constexpr double k_step = 1e-5;      // [s]

  ListCloud(std::size_t coarse, std::size_t fine, double speed, std::size_t tile_size = 512) {
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.law(sand, sand, 0.7, 0.4);
    laws_ = std::make_unique<particles::PairLawTable>(std::move(rig.laws),
                                                      std::vector<std::string>{"m0"}, k_diameter);
    for (int d = 0; d < 3; ++d) {
      images_.length[d] = k_box;
      images_.half[d] = 0.5 * k_box;
    }
    tiling_ = {coarse, tile_size};
    const sdk::Random random(17, 1);
    for (std::size_t n = 0; n < coarse + fine; ++n) {
      particles::NewGrain g;
      g.diameter = n < coarse ? k_diameter : 0.1 * k_diameter;
      for (int d = 0; d < 3; ++d) {
        g.position[d] = k_box * random.uniform(n, static_cast<std::uint32_t>(d));
        g.velocity[d] = speed * (2.0 * random.uniform(n, static_cast<std::uint32_t>(3 + d)) - 1.0);
      }
      particles.append(g, 1e-6, 0);
      particles.half_velocity(n)[3] = 0.5 * k_step;  // it has made steps
    }
    // So that the order of ids is not that of rows.
    std::vector<std::int32_t> order(coarse + fine);
    for (std::size_t n = 0; n < order.size(); ++n) {
      order[n] = static_cast<std::int32_t>(n < coarse ? coarse - 1 - n : 2 * coarse + fine - 1 - n);
    }
    particles.reorder(order);
  }

  [[nodiscard]] particles::ListScene scene() const {
    return {.particles = particles,
            .tiling = tiling_,
            .laws = *laws_,
            .surfaces = {},
            .images = images_,
            .gravity = gravity_,
            .origin = {0, 0, 0},
            .step = k_step,
            .largest_diameter = k_diameter};
  }
  /// All go straight on.
  void drift(double duration) {
    for (std::size_t n = 0; n < particles.size(); ++n) {
      for (std::size_t d = 0; d < 3; ++d) {
        particles.position(n)[d] += duration * particles.velocity(n)[d];
      }
    }
  }
  /// Whether two touch within a `duration` [s] if both go straight on.
  [[nodiscard]] bool will_touch(std::size_t i, std::size_t j, double duration) const {
    const particles::ListScene s = scene();
    const double* vi = particles.velocity(i);
    const double* vj = particles.velocity(j);
    return contact::approach_is_within(
        contact::nearest_image(images_, s.position(j), s.position(i)),
        {vi[0] - vj[0], vi[1] - vj[1], vi[2] - vj[2]}, duration, s.radius(i) + s.radius(j));
  }

  particles::ParticleStore particles;

 private:
  std::unique_ptr<particles::PairLawTable> laws_;
  contact::Images images_;
  particles::Tiling tiling_;
  double gravity_[4] = {0, 0, 0, 0};
};

}  // namespace dust::test

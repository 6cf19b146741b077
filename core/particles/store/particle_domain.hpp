// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/store/particle_store.hpp"
#include "setup/setup.hpp"

#include <array>
#include <cstddef>

namespace dust::particles {

/// The box that particles are in: what its sides do with them, and images across periodic ones.
class ParticleDomain {
 public:
  explicit ParticleDomain(const scenario::Setup& setup);

  [[nodiscard]] sdk::Vec3 min() const { return min_; }
  [[nodiscard]] sdk::Vec3 max() const { return max_; }
  [[nodiscard]] const contact::Images& images() const { return images_; }

  /// Puts particles beyond a periodic side back to the other one.
  void wrap(ParticleStore& particles) const;
  /// Positions are wrapped now and then only: whether one (x, y, z, radius) is so far beyond a
  /// periodic side that it is time.
  [[nodiscard]] bool is_far_out(const double* position) const {
    if (!is_periodic_) return false;
    for (int d = 0; d < 3; ++d) {
      const double x = position[d];
      const double slack = position[3];
      if (images_.length[d] > 0.0 && (x < min_[d] - slack || x > max_[d] + slack)) return true;
    }
    return false;
  }

  enum class Where { inside, escaped, lost };
  struct Place {
    Where where = Where::inside;
    std::size_t side = 0;  ///< that it is beyond, if not inside
  };
  /// One beyond an open side has escaped. One wholly beyond a wall is lost; dust squeezed against a
  /// wall by a coarse particle gets its centre into it and comes back out (the overlap is
  /// reported).
  [[nodiscard]] Place place_of(const double* position) const;

 private:
  sdk::Vec3 min_, max_;
  std::array<scenario::GrainSide, 6> sides_{};
  contact::Images images_;
  bool is_periodic_ = false;
};

}  // namespace dust::particles

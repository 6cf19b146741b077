// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/energy/energy_account.hpp"
#include "particles/motion/motion_rows.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// The kinetic energy of particles that make a step, and the work that gravity and the fluid do on
/// them. Made before they move, asked after; docs/theory/energy.md, eq. (2), (5), (6).
class MotionEnergy {
 public:
  MotionEnergy(const ParticleStore& particles, std::span<const std::int32_t> rows);
  /// `gravity`: four per material.
  void add_to(EnergySums& sums, const double* gravity) const;

 private:
  struct Before {
    double velocity[3], spin[3], impulse[3], since;
  };
  const ParticleStore& particles_;
  std::span<const std::int32_t> rows_;
  std::vector<Before> before_;
};

}  // namespace dust::particles

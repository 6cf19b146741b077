// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/store/particle_store.hpp"

#include <span>

namespace dust::particles {

/// Particles as their motion sees them, and what acts on all of them.
struct MotionRows : ParticleStore::Motion {
  const double* gravity = nullptr;  ///< four per material
  bool has_drag = false;

  static MotionRows of(ParticleStore& particles, std::span<const double> gravity) {
    return {particles.motion(), gravity.data(), particles.has_drag()};
  }
};

}  // namespace dust::particles

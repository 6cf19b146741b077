// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/grain_store.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dust::particles {

/// Particles as their motion sees them: rows of a ParticleStore.
struct MotionRows {
  double* position = nullptr;
  double* motion = nullptr;
  double* spin = nullptr;
  double* impulse = nullptr;
  const double* action = nullptr;
  const double* decay = nullptr;
  const std::int32_t* material = nullptr;
  const double* gravity = nullptr;  ///< four per material
  bool has_fluid = false;           ///< drag acts

  static MotionRows of(GrainStore& particles, std::span<const double> gravity, bool has_fluid) {
    return {.position = particles.position.data(),
            .motion = particles.motion.data(),
            .spin = particles.spin.data(),
            .impulse = particles.impulse.data(),
            .action = particles.action.data(),
            .decay = particles.decay.data(),
            .material = particles.material.data(),
            .gravity = gravity.data(),
            .has_fluid = has_fluid};
  }
};

}  // namespace dust::particles

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/store/particle_store.hpp"

#include <cstddef>
#include <span>

namespace dust::particles {

/// [m/s2] of a particle by all but its contacts: weight and drag, g + k (u - v). `gravity`: four
/// per material.
inline sdk::Vec3 free_acceleration(const ParticleStore& particles, std::span<const double> gravity,
                                   std::size_t row) {
  const double* g = gravity.data() + 4 * static_cast<std::size_t>(particles.material(row));
  const double* drag = particles.drag(row);
  return vector_of(g) + drag[3] * (vector_of(drag) - vector_of(particles.velocity(row)));
}

}  // namespace dust::particles

// SPDX-License-Identifier: Apache-2.0
#include "particles/energy/motion_energy.hpp"

#include "dust/sdk/sphere.hpp"

#include <algorithm>

namespace dust::particles {
namespace {

double dot3(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

MotionEnergy::MotionEnergy(const ParticleStore& particles, std::span<const std::int32_t> rows)
    : particles_(particles), rows_(rows), before_(rows.size()) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto n = static_cast<std::size_t>(rows[k]);
    std::copy_n(particles.half_velocity(n), 3, before_[k].velocity);
    std::copy_n(particles.half_rotation(n), 3, before_[k].spin);
    before_[k].since = particles.time_since_kick(n);
    if (particles.has_fluid()) {
      std::copy_n(particles.impulse(n), 3, before_[k].impulse);
    } else {
      std::fill_n(before_[k].impulse, 3, 0.0);
    }
  }
}

void MotionEnergy::add_to(EnergySums& sums, const double* gravity) const {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const auto n = static_cast<std::size_t>(rows_[k]);
    const Before& old = before_[k];
    const double mass = particles_.weight(n) / particles_.inverse_mass(n);
    const double inertia = sdk::sphere_inertia(mass, particles_.radius(n));
    // One that has just come stands at its velocity, the others half a step behind.
    const bool is_new = old.since == 0.0;
    const double* velocity = is_new ? old.velocity : particles_.half_velocity(n);
    const double* spin = is_new ? old.spin : particles_.half_rotation(n);
    sums.translation += 0.5 * mass * dot3(old.velocity, velocity);
    sums.rotation += 0.5 * inertia * dot3(old.spin, spin);
    const double* g = gravity + 4 * static_cast<std::ptrdiff_t>(particles_.material(n));
    sums.gravity += mass * dot3(g, old.velocity) * (2.0 * old.since);
    if (!particles_.has_fluid()) continue;
    const double* impulse = particles_.impulse(n);
    const double* now = particles_.half_velocity(n);
    double work = 0.0;
    for (int d = 0; d < 3; ++d) {
      work += 0.5 * (impulse[d] - old.impulse[d]) * (old.velocity[d] + now[d]);
    }
    sums.fluid += particles_.weight(n) * work;
  }
}

}  // namespace dust::particles

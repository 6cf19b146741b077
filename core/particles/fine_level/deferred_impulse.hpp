// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/store/particle_store.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// Impulse (per mass; angular, per moment of inertia) that fine particles have given to a coarse
/// one and that acts in its next step: its row shows the mean velocity of the step, the way over
/// the time, and this is added before the next kick.
struct DeferredImpulse {
  std::int32_t particle = 0;
  sdk::Vec3 velocity, angular_velocity;  ///< [m/s], [rad/s] at the end of the step, less the mean
  /// Half of the last kick: predicted to the instant of the position, less that at the end.
  sdk::Vec3 predicted_velocity, predicted_angular_velocity;

  DeferredImpulse& operator+=(const DeferredImpulse& other);
  /// Before the particle's next kick.
  void act_on(ParticleStore& particles) const;
};

/// The deferred impulses of one coarse step: one per particle, in the order of particles.
class DeferredImpulses {
 public:
  void clear() { impulses_.clear(); }
  void add(const DeferredImpulse& impulse) { impulses_.push_back(impulse); }
  /// Ends a series of add(): what clusters have given to one particle is added up, in their order.
  void merge();

  [[nodiscard]] std::span<const DeferredImpulse> all() const { return impulses_; }
  /// Of particles [begin, end).
  [[nodiscard]] std::span<const DeferredImpulse> of(std::int32_t begin, std::int32_t end) const;
  /// Of one particle, or null.
  [[nodiscard]] const DeferredImpulse* find(std::int32_t particle) const;
  /// Particle n becomes new_index[n], or is gone where that is negative.
  void renumber(std::span<const std::int32_t> new_index);

  [[nodiscard]] std::uint64_t digest() const;

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  std::vector<DeferredImpulse> impulses_;
};

}  // namespace dust::particles

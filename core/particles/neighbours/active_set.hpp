// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/store/particle_store.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// The particles of a tile, or of the fine level, that make every step of an inner list, and the
/// straight trajectories that the list supposes of them. Those that stand in no list of another
/// tile come first: no other tile looks at them.
class ActiveSet {
 public:
  void clear();
  /// From its position and velocity on, it may be off the trajectory by `skin` [m].
  void add(const ParticleStore& particles, std::size_t row, double skin);
  /// All up to here are unshared, those that follow are shared.
  void end_unshared() { unshared_ = rows_.size(); }

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] std::span<const std::int32_t> all() const { return rows_; }
  [[nodiscard]] std::size_t unshared_count() const { return unshared_; }
  [[nodiscard]] std::span<const std::int32_t> unshared() const { return all().first(unshared_); }

  /// What a look at the trajectories finds.
  struct Check {
    bool is_skin_used_up = false;    ///< of one of them, now or at the next look
    std::int32_t not_a_number = -1;  ///< a particle whose position is none; the look ends there
  };
  /// At `t` [s] after the list was made; the next look comes after `ahead` [s].
  [[nodiscard]] Check check(const ParticleStore& particles, double t, double ahead) const;

 private:
  /// Single precision does for what is checked against it.
  struct Reference {
    double position[3];
    float velocity[3];
    float skin;
  };
  std::vector<std::int32_t> rows_;
  std::vector<Reference> reference_;
  std::size_t unshared_ = 0;
};

}  // namespace dust::particles

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/aligned.hpp"
#include "dust/sdk/archive.hpp"
#include "dust/sdk/vec3.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dust::particles {

/// How far a particle is off its reference trajectory, now and at the next look if it goes straight
/// on: squares [m2].
struct Deviation {
  double now2 = 0.0, next2 = 0.0;

  /// Share of the skin at which a new list is asked for.
  static constexpr double k_trigger = 0.7;
  [[nodiscard]] bool asks_for_another(double skin) const {
    return std::max(now2, next2) > k_trigger * k_trigger * skin * skin;
  }
};

/// What a pair list relies on: every particle goes straight on from where it was when the list was
/// made, x0 + v0 t, and stays within its skin of that. t [s] counts from there.
class ReferenceTrajectories {
 public:
  void resize(std::size_t count) {
    rows_.resize(4 * count, 0.0);
    velocity_.resize(4 * count, 0.0F);
  }
  /// Row n becomes what row order[n] was.
  void reorder(std::span<const std::int32_t> order);

  /// The list is made now: from this position with this velocity. Keeps the skin.
  void restart(std::size_t row, const double* position, const double* velocity) {
    for (std::size_t d = 0; d < 3; ++d) {
      rows_[4 * row + d] = position[d];
      velocity_[4 * row + d] = static_cast<float>(velocity[d]);
    }
  }
  /// The list was made `t` ago: the trajectory passes through this position now.
  void restart(std::size_t row, const double* position, const double* velocity, double t) {
    for (std::size_t d = 0; d < 3; ++d) {
      const auto v = static_cast<float>(velocity[d]);
      velocity_[4 * row + d] = v;
      rows_[4 * row + d] = position[d] - t * static_cast<double>(v);
    }
  }
  void set_skin(std::size_t row, double skin) { rows_[4 * row + 3] = skin; }
  [[nodiscard]] double skin(std::size_t row) const { return rows_[4 * row + 3]; }

  [[nodiscard]] sdk::Vec3 velocity(std::size_t row) const {
    const float* v = velocity_.data() + 4 * row;
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  }
  [[nodiscard]] sdk::Vec3 position(std::size_t row, double t) const {
    const double* p = rows_.data() + 4 * row;
    return sdk::Vec3{p[0], p[1], p[2]} + t * velocity(row);
  }
  /// Of a particle at `p` with the velocity `v`, when the next look comes after `ahead` [s].
  [[nodiscard]] Deviation deviation(std::size_t row, const double* p, const double* v, double t,
                                    double ahead) const {
    const double* p0 = rows_.data() + 4 * row;
    const float* v0 = velocity_.data() + 4 * row;
    Deviation result;
    for (int d = 0; d < 3; ++d) {
      const double off = p[d] - p0[d] - t * v0[d];
      const double next = off + ahead * (v[d] - v0[d]);
      result.now2 += off * off;
      result.next2 += next * next;
    }
    return result;
  }
  /// Rows of four: x0 and the skin.
  [[nodiscard]] const double* rows() const { return rows_.data(); }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  contact::AlignedVector<double> rows_;
  /// Single precision is fine enough for the check.
  contact::AlignedVector<float> velocity_;
};

}  // namespace dust::particles

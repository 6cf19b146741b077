// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/aligned.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dust::particles {

/// What the contacts of each particle have dissipated since it was last asked: for dust that comes
/// off in them. Kept only where a run has such dust. Zeros between fluid steps, so that nothing of
/// it is saved.
class ContactWork {
 public:
  /// [J] along the normals, and by sliding and rolling.
  struct Energy {
    double normal = 0.0;
    double tangential = 0.0;
    [[nodiscard]] double sum() const { return normal + tangential; }
  };

  /// Begins to keep it, for so many walls.
  void begin(std::size_t walls, std::size_t particles);
  [[nodiscard]] bool is_on() const { return width_ > 0; }
  [[nodiscard]] std::size_t walls() const { return walls_; }

  /// Of contacts with other particles: this one's half.
  [[nodiscard]] Energy with_particles(std::size_t row) const { return at(row, k_pairs); }
  [[nodiscard]] Energy with_wall(std::size_t row, std::size_t wall) const {
    return at(row, k_first_wall + 2 * wall);
  }
  [[nodiscard]] Energy sum(std::size_t row) const;
  /// [m/s2] largest that all contacts together have given it.
  [[nodiscard]] double acceleration(std::size_t row) const {
    return numbers_[width_ * row + k_acceleration];
  }

  void add_with_particles(std::size_t row, double normal, double tangential) {
    add(row, k_pairs, normal, tangential);
  }
  void add_with_wall(std::size_t row, std::size_t wall, double normal, double tangential) {
    add(row, k_first_wall + 2 * wall, normal, tangential);
  }
  void note_acceleration(std::size_t row, double acceleration) {
    double& largest = numbers_[width_ * row + k_acceleration];
    largest = std::max(largest, acceleration);
  }
  /// Zeros in all rows.
  void clear();

  /// Particles have come at the end of the rows.
  void resize(std::size_t particles) { numbers_.resize(width_ * particles, 0.0); }
  void reorder(std::span<const std::int32_t> order);

 private:
  static constexpr std::size_t k_acceleration = 0, k_pairs = 1, k_first_wall = 3;

  [[nodiscard]] Energy at(std::size_t row, std::size_t column) const {
    const double* e = numbers_.data() + width_ * row + column;
    return {e[0], e[1]};
  }
  void add(std::size_t row, std::size_t column, double normal, double tangential) {
    double* e = numbers_.data() + width_ * row + column;
    e[0] += normal;
    e[1] += tangential;
  }

  std::size_t walls_ = 0;
  std::size_t width_ = 0;  ///< numbers per row; 0: not kept
  contact::AlignedVector<double> numbers_;
};

}  // namespace dust::particles

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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
  [[nodiscard]] bool is_on() const { return is_on_; }
  [[nodiscard]] std::size_t walls() const { return walls_; }

  /// Of contacts with other particles: this one's half, per real particle.
  [[nodiscard]] Energy with_particles(std::size_t row) const {
    return of_rows_[row].with_particles;
  }
  [[nodiscard]] Energy with_wall(std::size_t row, std::size_t wall) const {
    return of_walls_[walls_ * row + wall];
  }
  [[nodiscard]] Energy sum(std::size_t row) const;
  /// [m/s2] largest that all contacts together have given it.
  [[nodiscard]] double acceleration(std::size_t row) const { return of_rows_[row].acceleration; }

  void add_with_particles(std::size_t row, double normal, double tangential) {
    add(of_rows_[row].with_particles, normal, tangential);
  }
  void add_with_wall(std::size_t row, std::size_t wall, double normal, double tangential) {
    add(of_walls_[walls_ * row + wall], normal, tangential);
  }
  void note_acceleration(std::size_t row, double acceleration) {
    double& largest = of_rows_[row].acceleration;
    largest = std::max(largest, acceleration);
  }
  /// Zeros in all rows.
  void clear();

  /// Particles have come at the end of the rows.
  void resize(std::size_t particles);
  void reorder(std::span<const std::int32_t> order);

 private:
  struct OfRow {
    double acceleration = 0.0;
    Energy with_particles;
  };
  static void add(Energy& to, double normal, double tangential) {
    to.normal += normal;
    to.tangential += tangential;
  }

  bool is_on_ = false;
  std::size_t walls_ = 0;
  /// Apart from those of the walls: each step writes all of them.
  std::vector<OfRow> of_rows_;
  std::vector<Energy> of_walls_;
};

}  // namespace dust::particles

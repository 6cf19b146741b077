// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/aligned.hpp"
#include "contact/batch_kernels.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// Share of a pair's force that a grain of a statistical `weight` feels beside one of the weight
/// `other`: the lighter feels all of it; docs/theory/rare_grains.md, eq. (1).
inline double felt_share(double weight, double other) {
  return other < weight ? other / weight : 1.0;
}

/// The grains, row by row. Rows of four doubles unless said otherwise.
///
/// Positions stand at the time x^n; half_velocity at x^n minus the lag in its fourth column (half a
/// step, zero for a grain that has just come); velocity is the one predicted for x^n.
struct GrainStore {
  static constexpr std::size_t k_motion_stride = contact::k_motion_stride;
  contact::AlignedVector<double> position;  ///< x, y, z, radius
  /// Eight per grain, a line of the cache: velocity, 1 / mass, half velocity, lag [s].
  contact::AlignedVector<double> motion;
  /// The same of the rotation; fourth and eighth the radius again, for who wants no position.
  contact::AlignedVector<double> spin;
  contact::AlignedVector<double> action;   ///< target velocity, rate [1/s]; empty without a fluid
  contact::AlignedVector<double> impulse;  ///< empty without a fluid
  /// Two per grain: exp(-k dt), (1 - exp(-k dt)) / (k dt); empty without a fluid.
  contact::AlignedVector<double> decay;
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> material;
  std::vector<std::int32_t> population;  ///< index into the balance book
  std::vector<double> weight;

  bool has_fluid = false;  ///< a fluid is declared: the columns for it are there

  [[nodiscard]] std::size_t size() const { return id.size(); }
  [[nodiscard]] double* velocity(std::size_t row) { return motion.data() + k_motion_stride * row; }
  [[nodiscard]] const double* velocity(std::size_t row) const {
    return motion.data() + k_motion_stride * row;
  }
  [[nodiscard]] double* rotation(std::size_t row) { return spin.data() + k_motion_stride * row; }
  [[nodiscard]] const double* rotation(std::size_t row) const {
    return spin.data() + k_motion_stride * row;
  }
  [[nodiscard]] double* half_velocity(std::size_t row) { return velocity(row) + 4; }
  [[nodiscard]] const double* half_velocity(std::size_t row) const { return velocity(row) + 4; }
  [[nodiscard]] double* half_rotation(std::size_t row) { return rotation(row) + 4; }
  [[nodiscard]] const double* half_rotation(std::size_t row) const { return rotation(row) + 4; }
  /// Target velocity and rate of a grain; zeros without a fluid.
  [[nodiscard]] const double* action_of(std::size_t row) const {
    static constexpr double k_none[4] = {};
    return has_fluid ? action.data() + 4 * row : k_none;
  }
  void resize(std::size_t count);
  /// Row n becomes what row order[n] was; rows not named are dropped.
  void reorder(std::span<const std::int32_t> order);
};

}  // namespace dust::particles

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/aligned.hpp"
#include "dust/sdk/cohesion_law.hpp"

#include <array>
#include <cstddef>

namespace dust::contact {

/// Contacts per call of a law: the columns stay in the first two cache levels.
inline constexpr std::size_t k_batch = 64;
/// Column stride; not a power of two, which would alias the columns in the first-level cache.
inline constexpr std::size_t k_stride = k_batch + 8;
/// Largest history of a contact (contact, rolling and cohesion stage, accounts) in columns.
inline constexpr int k_max_history = 24;

/// Number of rows a law sees for `count` contacts: the next multiple of eight.
constexpr std::size_t padded(std::size_t count) { return (count + 7) / 8 * 8; }

/// Columns of one batch, private to a thread.
class BatchColumns {
 public:
  enum Name {
    separation_x,  ///< [m] centre of i minus centre of j
    separation_y,
    separation_z,
    radius_i,        ///< [m]
    radius_j,        ///< [m] that of the grain for a surface
    inverse_mass_i,  ///< [1/kg]
    inverse_mass_j,  ///< [1/kg] 0 for a surface
    velocity_x,      ///< [m/s] of the centres, later of the contact point
    velocity_y,
    velocity_z,
    displacement_x,  ///< [m] of the centres since the last look, later of the contact point
    displacement_y,
    displacement_z,
    distance,  ///< [m] of the centres
    overlap,
    normal_x,
    normal_y,
    normal_z,
    rotation_x,
    rotation_y,
    rotation_z,
    angle_x,
    angle_y,
    angle_z,
    effective_radius,
    effective_mass,
    lever_i,  ///< [m] centre of i to the contact point
    lever_j,
    normal_force,
    normal_stiffness,
    tangential_stiffness,
    force_x,
    force_y,
    force_z,
    torque_x,
    torque_y,
    torque_z,
    torque_i_x,  ///< [N m] on i about its centre
    torque_i_y,
    torque_i_z,
    torque_j_x,
    torque_j_y,
    torque_j_z,
    scale_i,  ///< [-] share of the force side i feels (statistical weights)
    scale_j,
    contact_overlap,  ///< [m] what the contact law sees under cohesion
    attraction,       ///< [N]
    normal_velocity,  ///< [m/s] what a cohesive law sees
    first_history,
    /// [rad/s] of the surface at the contact; behind all, because most surfaces do not turn.
    surface_rotation_x = first_history + k_max_history,
    surface_rotation_y,
    surface_rotation_z,
    k_columns,
    // What is read before the laws write stands where they write: with columns of their own a batch
    // would not stay in the first-level cache.
    rotation_i_x = force_x,
    rotation_i_y,
    rotation_i_z,
    rotation_j_x,
    rotation_j_y,
    rotation_j_z,
    angle_i_x = torque_i_x,  ///< [rad] turned since the last look
    angle_i_y,
    angle_i_z,
    angle_j_x,
    angle_j_y,
    angle_j_z
  };

  BatchColumns();
  BatchColumns(const BatchColumns&) = delete;
  BatchColumns& operator=(const BatchColumns&) = delete;
  [[nodiscard]] double* column(int name) {
    return data_.data() + static_cast<std::size_t>(name) * k_stride;
  }
  [[nodiscard]] sdk::MutableVectorColumns mutable_vectors(int first) {
    return {column(first), column(first + 1), column(first + 2)};
  }
  /// Three columns from `first` on.
  [[nodiscard]] sdk::VectorColumns vectors(int first) {
    return {column(first), column(first + 1), column(first + 2)};
  }
  [[nodiscard]] double* const* history() const { return history_.data(); }
  /// Laws find the histories in columns elsewhere, `stride` apart (HistoryElsewhere), or again in
  /// the last columns.
  void keep_history_at(double* first, std::size_t stride) {
    for (auto& column : history_) column = first, first += stride;
  }
  void keep_history_here() { keep_history_at(column(first_history), k_stride); }

  /// The batch that contact and rolling law see.
  [[nodiscard]] sdk::ContactBatch view(std::size_t count, double time_step) const;
  /// That of the cohesion; `first_history_column` skips the columns of the other two.
  [[nodiscard]] sdk::CohesionBatch cohesion_view(std::size_t count, double time_step,
                                                 int first_history_column);

 private:
  AlignedVector<double> data_;
  std::array<double*, k_max_history> history_{};
  sdk::ContactBatch batch_;  ///< where the columns stand: small batches would spend long on it
};

/// While it lives, a batch may have its histories elsewhere; then they are at home again, also
/// after a law has thrown: the thread's next batch may be another solver's.
class HistoryElsewhere {
 public:
  explicit HistoryElsewhere(BatchColumns& columns) : columns_(columns) {}
  ~HistoryElsewhere() { columns_.keep_history_here(); }
  HistoryElsewhere(const HistoryElsewhere&) = delete;
  HistoryElsewhere& operator=(const HistoryElsewhere&) = delete;
  void keep_at(double* first, std::size_t stride) { columns_.keep_history_at(first, stride); }

 private:
  BatchColumns& columns_;
};

}  // namespace dust::contact

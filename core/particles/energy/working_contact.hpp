// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/energy/energy_account.hpp"

#include <cstddef>
#include <cstdint>

namespace dust::particles {

/// History columns that the account keeps of a contact, behind those of the laws: the normal force,
/// the tangential force and the couple of the last step.
inline constexpr int k_energy_columns = 7;

/// How the two sides of the contacts of a batch have moved in the last step. The laws are shown
/// only what has happened since touch, and write where it stands: so it is copied before.
class ContactMotion {
 public:
  /// Pairs that have been gathered, before anything is derived.
  void take_pairs(contact::BatchColumns& columns, std::size_t count);
  /// A particle at a wall: displacement [m] of its centre and angle [rad].
  void set_particle(std::size_t q, sdk::Vec3 displacement, sdk::Vec3 angle);
  /// What the walls have done, once derive_wall_columns() has found it.
  void take_walls(contact::BatchColumns& columns, std::size_t count, bool is_turning);

  [[nodiscard]] sdk::Vec3 displacement(std::size_t q) const { return displacement_[q]; }
  [[nodiscard]] sdk::Vec3 angle_i(std::size_t q) const { return angle_i_[q]; }
  [[nodiscard]] sdk::Vec3 angle_j(std::size_t q) const { return angle_j_[q]; }
  [[nodiscard]] sdk::Vec3 wall(std::size_t q) const { return wall_[q]; }
  [[nodiscard]] sdk::Vec3 wall_angle(std::size_t q) const { return wall_angle_[q]; }

 private:
  sdk::Vec3 displacement_[contact::k_batch];  ///< of i relative to j; of i at a wall
  sdk::Vec3 angle_i_[contact::k_batch], angle_j_[contact::k_batch];
  sdk::Vec3 wall_[contact::k_batch];        ///< displacement of the wall
  sdk::Vec3 wall_angle_[contact::k_batch];  ///< that it has turned by
};

/// Of the calling thread, filled only where an account is kept.
ContactMotion& thread_motion();

/// A contact of which the account has something to say.
struct WorkingContact {
  sdk::Vec3 normal;
  double approach;          ///< [m] by which the overlap has grown in the step
  sdk::Vec3 slip;           ///< [m] displacement of the contact point
  sdk::Vec3 turn;           ///< [rad] relative rotation
  sdk::Vec3 wall;           ///< [m] displacement of the wall
  sdk::Vec3 wall_angle;     ///< [rad] rotation of the wall
  sdk::Vec3 force, couple;  ///< [N], [N m] on i, now
  double weight;            ///< statistical
};

/// Adds the work of a contact over the last step by the means of the forces at its two ends, and
/// keeps the new ones in `history`, `stride` apart; docs/theory/energy.md, eq. (3), (4).
void add_work(const WorkingContact& c, double* history, std::size_t stride, EnergySums& sums);

}  // namespace dust::particles

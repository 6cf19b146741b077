// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/digest.hpp"
#include "contact/aligned.hpp"
#include "contact/batch_kernels.hpp"
#include "dust/sdk/archive.hpp"
#include "particles/grain_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

struct NewGrain;

/// Share of a pair's force that a particle of a statistical `weight` feels beside one of the weight
/// `other`: the lighter feels all of it; docs/theory/rare_grains.md, eq. (1).
inline double felt_share(double weight, double other) {
  return other < weight ? other / weight : 1.0;
}

/// The first three numbers of a row.
inline sdk::Vec3 vector_of(const double* row) { return {row[0], row[1], row[2]}; }

/// The particles, row by row: the only owner of what moves. How numbers are packed is its own
/// affair, but for the kernels that are given views.
///
/// Positions stand at the time x^n; half_velocity at x^n minus the time since the last kick in its
/// fourth number (half a step, zero for a particle that has just come); velocity is the one
/// predicted for x^n.
class ParticleStore {
 public:
  static constexpr std::size_t k_motion_stride = contact::k_motion_stride;

  /// `has_fluid`: a fluid is declared, there is room for what it does.
  explicit ParticleStore(bool has_fluid = false) : has_fluid_(has_fluid) {}

  [[nodiscard]] std::size_t size() const { return id_.size(); }
  [[nodiscard]] bool has_fluid() const { return has_fluid_; }

  // --- One particle.
  [[nodiscard]] double* position(std::size_t row) { return position_.data() + 4 * row; }
  [[nodiscard]] const double* position(std::size_t row) const { return position_.data() + 4 * row; }
  [[nodiscard]] double radius(std::size_t row) const { return position_[4 * row + 3]; }
  [[nodiscard]] double inverse_mass(std::size_t row) const { return velocity(row)[3]; }
  [[nodiscard]] double* velocity(std::size_t row) { return motion_.data() + k_motion_stride * row; }
  [[nodiscard]] const double* velocity(std::size_t row) const {
    return motion_.data() + k_motion_stride * row;
  }
  [[nodiscard]] double* rotation(std::size_t row) { return spin_.data() + k_motion_stride * row; }
  [[nodiscard]] const double* rotation(std::size_t row) const {
    return spin_.data() + k_motion_stride * row;
  }
  [[nodiscard]] double* half_velocity(std::size_t row) { return velocity(row) + 4; }
  [[nodiscard]] const double* half_velocity(std::size_t row) const { return velocity(row) + 4; }
  [[nodiscard]] double* half_rotation(std::size_t row) { return rotation(row) + 4; }
  [[nodiscard]] const double* half_rotation(std::size_t row) const { return rotation(row) + 4; }
  /// [s] half a step, less for a particle that has just come.
  [[nodiscard]] double time_since_kick(std::size_t row) const { return half_velocity(row)[3]; }
  void set_time_since_kick(std::size_t row, double time) { half_velocity(row)[3] = time; }
  [[nodiscard]] std::int64_t id(std::size_t row) const { return id_[row]; }
  [[nodiscard]] std::int32_t material(std::size_t row) const { return material_[row]; }
  [[nodiscard]] std::int32_t population(std::size_t row) const { return population_[row]; }
  [[nodiscard]] double weight(std::size_t row) const { return weight_[row]; }
  /// Drag relaxation: target velocity and rate [1/s]; zeros without a fluid.
  [[nodiscard]] const double* drag(std::size_t row) const {
    static constexpr double k_none[4] = {};
    return has_fluid_ ? of_fluid_.drag.data() + 4 * row : k_none;
  }
  /// [1/s]
  [[nodiscard]] double relaxation_rate(std::size_t row) const { return drag(row)[3]; }
  /// What drag leaves of a velocity difference in a step: exp(-k dt); 1 without a fluid.
  [[nodiscard]] double decay(std::size_t row) const {
    return has_fluid_ ? of_fluid_.decay[2 * row] : 1.0;
  }
  /// [N s] received through drag. With a fluid only.
  [[nodiscard]] double* impulse(std::size_t row) { return of_fluid_.impulse.data() + 4 * row; }
  [[nodiscard]] const double* impulse(std::size_t row) const {
    return of_fluid_.impulse.data() + 4 * row;
  }

  /// Number of the opening that it has touched, -1 = none.
  [[nodiscard]] int touched_opening(std::size_t row) const {
    return touched_.empty() ? -1 : touched_[row];
  }

  // --- Views: rows as kernels and the coupling see them, valid until particles come or go.
  [[nodiscard]] contact::RowView contact_rows() const {
    return {position_.data(), motion_.data(), spin_.data()};
  }
  [[nodiscard]] GrainRows rows();
  struct Motion {
    double* position;  ///< x, y, z, radius
    /// Eight per particle, a line of the cache: velocity, 1 / mass, half velocity, its time [s].
    double* motion;
    double* spin;  ///< the same of the rotation; fourth and eighth the radius again
    double* impulse;
    const double* drag;
    const double* decay;  ///< two per particle: exp(-k dt), (1 - exp(-k dt)) / (k dt)
    const std::int32_t* material;
  };
  [[nodiscard]] Motion motion();
  /// One per particle, see touched_opening; empty without openings.
  [[nodiscard]] std::span<std::int32_t> touched_openings() { return touched_; }

  // --- Particles come and go.
  /// At the end of the rows, with the next id. `mass` [kg] of a real particle.
  void append(const NewGrain& grain, double mass, std::int32_t population);
  /// Becomes the particles of another store, row by row, whose materials and openings have the
  /// numbers here that are given by theirs (-1: none); `mass` [kg] by population.
  void transfer_from(const ParticleStore& other, std::span<const std::int32_t> materials,
                     std::span<const std::int32_t> openings, std::span<const double> mass);
  /// Row n becomes what row order[n] was; rows not named are dropped.
  void reorder(std::span<const std::int32_t> order);
  /// There is room for the wind at particles, see GrainRows; it is not saved, for the coupling
  /// writes it anew in each step. With a fluid only.
  void keep_wind();
  /// Whether there are openings that particles may touch.
  void set_openings(bool has_openings);
  /// Drag has been rewritten: what it leaves over a step [s].
  void update_decay(double step);
  [[nodiscard]] bool has_drag() const { return has_drag_; }  ///< it acts on some
  /// Whether the first `count` have different statistical weights.
  [[nodiscard]] bool has_weights(std::size_t count) const;

  [[nodiscard]] std::int64_t next_id() const { return next_id_; }

  [[nodiscard]] std::uint64_t position_digest() const;
  [[nodiscard]] std::uint64_t motion_digest() const;
  [[nodiscard]] std::uint64_t drag_digest() const;
  [[nodiscard]] std::uint64_t impulse_digest() const;
  void save(sdk::ArchiveWriter& archive) const;
  /// `next_id` and `has_drag` stand among other numbers of the solver.
  void load(sdk::ArchiveReader& archive, std::int64_t next_id, bool has_drag);

 private:
  bool has_fluid_;
  bool has_drag_ = false;
  bool has_openings_ = false;
  std::int64_t next_id_ = 0;
  contact::AlignedVector<double> position_;
  contact::AlignedVector<double> motion_;
  contact::AlignedVector<double> spin_;
  /// What a fluid does to particles; empty without one.
  struct OfFluid {
    contact::AlignedVector<double> drag, impulse, decay;
    contact::AlignedVector<double> wind;  ///< empty unless kept
    bool keeps_wind = false;
  } of_fluid_;
  std::vector<std::int64_t> id_;
  std::vector<std::int32_t> material_;
  std::vector<std::int32_t> population_;  ///< index into the balance ledger
  std::vector<double> weight_;
  std::vector<std::int32_t> touched_;  ///< number of an opening or -1; empty without openings
};

}  // namespace dust::particles

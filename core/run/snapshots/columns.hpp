// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "dust/sdk/sensor.hpp"
#include "fluid/fluid_solver.hpp"
#include "particles/grain_rows.hpp"
#include "setup/setup.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace dust::run {

/// The grains as columns in the order of their ids, copied once per fluid step for sensors and
/// files, with the places of the sample before.
class GrainTable {
 public:
  explicit GrainTable(const scenario::DomainSpec& domain);
  /// Notes where grains came in: every row with an id not seen at the last sample.
  void note_insertions(const particles::GrainRows& rows);
  void publish(const particles::GrainRows& rows, std::span<const double> force);
  [[nodiscard]] sdk::GrainColumns columns() const;
  /// With places as the solver has them, which is part of its state.
  [[nodiscard]] sdk::GrainColumns columns_of_solver() const;
  /// The row of each published grain.
  [[nodiscard]] std::span<const std::size_t> order() const { return order_; }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  struct Place {
    std::int64_t id;
    double x, y, z;
  };
  /// The rows in the order of their ids.
  void find_order(const particles::GrainRows& rows);
  void take_places_before();
  /// The image of a coordinate along d that lies in the domain: positions are wrapped at periodic
  /// sides now and then only.
  [[nodiscard]] double in_domain(double x, int d) const;

  sdk::Vec3 min_;
  sdk::Vec3 period_;  ///< [m] of the domain; 0 where it is not periodic
  std::vector<std::int64_t> id_;
  std::vector<std::int32_t> material_;
  std::vector<double> number_[23];
  std::vector<Place> before_;       ///< of the last sample, by id
  std::vector<Place> insertions_;   ///< since the last sample, by id
  std::vector<std::size_t> order_;  ///< rows by id
};

/// The fluid at cell centres in single precision, x fastest, without halo.
class FluidTable {
 public:
  FluidTable(const fluid::Grid& grid, const scenario::FluidSpec& fluid,
             const fluid::CellField& open_fraction);
  void publish(const fluid::FluidSolver& solver, const fluid::CellField& void_fraction);
  /// After bodies have moved.
  void set_open_fraction(const fluid::CellField& open_fraction);
  [[nodiscard]] sdk::FluidColumns columns() const;

 private:
  /// Velocities at the centres that times the void fraction are the mean of the fluxes through the
  /// two faces: what flows through a bed is the same in each of its layers.
  void publish_velocity(const fluid::FluidSolver& solver);
  /// Where the row of cells `step` beside (j, k) along d begins; that of (j, k) beyond a side.
  [[nodiscard]] std::size_t row_beside(int d, int step, int j, int k) const;

  fluid::Grid grid_;
  double density_;
  double viscosity_;
  std::vector<float> velocity_[3];
  std::vector<float> pressure_;
  std::vector<float> void_fraction_;
  std::vector<float> open_fraction_;
};

}  // namespace dust::run

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/fluid_solver.hpp"
#include "particles/dem.hpp"
#include "run/snapshots/columns.hpp"
#include "run/snapshots/contact_table.hpp"
#include "run/snapshots/face_table.hpp"
#include "setup/setup.hpp"

#include <optional>

namespace dust::run {

/// Copies of particles, contacts and fluid for sensors and files, taken once per fluid step.
class Snapshots {
 public:
  /// What sensors of the run want beyond what is always copied.
  struct Wanted {
    bool contacts = false;
    bool face_fluxes = false;
  };
  Snapshots(const scenario::DomainSpec& domain, Wanted wanted)
      : particles_(domain), wanted_(wanted) {}

  /// Where there is a fluid.
  void use_fluid(const fluid::Grid& grid, const scenario::FluidSpec& fluid,
                 const fluid::CellField& open_fraction) {
    fluid_.emplace(grid, fluid, open_fraction);
    if (wanted_.face_fluxes) faces_.emplace(grid);
  }
  /// After bodies have moved.
  void set_open_fraction(const fluid::CellField& open_fraction) {
    fluid_->set_open_fraction(open_fraction);
  }

  /// Notes where particles came in since the last copy.
  void note_insertions(const particles::GrainRows& rows) { particles_.note_insertions(rows); }
  void take(particles::Dem& dem, double time);
  /// Not while somebody else asks for what passes the faces, where they are copied.
  void take(fluid::FluidSolver& fluid, const fluid::CellField& void_fraction,
            FaceTable::Moment moment);
  [[nodiscard]] bool has_face_fluxes() const { return faces_.has_value(); }

  /// With places as the solver has them.
  [[nodiscard]] sdk::GrainColumns particles() const { return particles_.columns_of_solver(); }
  /// Fills in what there is of particles, contacts and fluid.
  void show(sdk::WorldView& view) const;

  /// The positions of the copy before.
  void save(sdk::ArchiveWriter& archive) const { particles_.save(archive); }
  void load(sdk::ArchiveReader& archive) { particles_.load(archive); }

 private:
  GrainTable particles_;
  ContactTable contacts_;
  Wanted wanted_;
  std::optional<FluidTable> fluid_;
  std::optional<FaceTable> faces_;
};

}  // namespace dust::run

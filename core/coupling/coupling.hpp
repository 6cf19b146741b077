// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/coupling_report.hpp"
#include "coupling/fluid_state.hpp"
#include "coupling/step_drag.hpp"
#include "dust/sdk/archive.hpp"
#include "dust/sdk/boundary_condition.hpp"
#include "dust/sdk/drag_law.hpp"
#include "dust/sdk/fluid_force.hpp"
#include "dust/sdk/voidage_rule.hpp"
#include "fluid/geometry/thin_bodies.hpp"
#include "fluid/grid.hpp"
#include "particles/grain_rows.hpp"
#include "particles/surfaces.hpp"
#include "setup/setup.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace dust::coupling {

/// Momentum exchange between grains and fluid. During a fluid step:
///   begin_step()  void fraction of the grains where they are, drag for the fluid, linearised
///   (the fluid solver advances with exchange())
///   evaluate()    the impulse that each grain's drag took from the fluid
///   refresh()     several times during the DEM cycle: target velocity and rate of each grain from
///                 the fluid at its position; grains integrate drag exactly in between
///   end_step()    what the grains really received; the difference to what the fluid was given is
///                 given to the fluid in the next step, so that the sum over time is exact.
/// Each stage takes what the one before it returns. The equations and their derivation:
/// docs/theory/coupling.md.
///
/// Where the scenario lets both overlap, the fluid advances while the grains go through their cycle
/// in the fluid of the step before (a copy that the caller keeps); evaluate() follows both.
///
/// Grains are recognised by their id: rows may be reordered at any time. Insert and remove grains
/// between end_step() and begin_step(); one removed earlier takes along what it received in that
/// fluid step.
class Coupling {
 public:
  /// `open_fraction`: share of each cell outside all bodies (FluidSolver::open_fraction), kept by
  /// reference to read at construction only. Throws sdk::ModelError for a fluid without
  /// viscosity.
  Coupling(const scenario::Setup& setup, const fluid::Grid& grid,
           const fluid::CellField& open_fraction, const sdk::VoidageRule& voidage,
           const sdk::DragLaw& drag);
  ~Coupling();
  Coupling(const Coupling&) = delete;
  Coupling& operator=(const Coupling&) = delete;

  /// Optional, before the first begin_step(): forces besides drag, and the walls that some of them
  /// act at, beside which a grain's own flow is another, too. The models are kept by reference.
  /// With buoyancy among what they take over, the DEM must not reduce gravity
  /// (takes_over_buoyancy).
  void use(std::span<const std::unique_ptr<sdk::FluidForce>> forces,
           std::vector<particles::Surface> surfaces);

  /// Optional: what the boundaries do to the fluid, null where periodic; without it all others
  /// count as walls. A grain's own flow is another beside them.
  void use_boundaries(const std::array<const sdk::BoundaryCondition*, 6>& boundaries);

  /// Optional: the bodies thinner than a cell, kept by reference. Grains then act on the fluid of
  /// their own side alone.
  void use_thin_bodies(const fluid::ThinBodies& bodies);

  /// Optional, before the run: throws base::UserError if a grain of one of the `diameters` [m] is
  /// too large for the grid. begin_step() finds the same later, as sdk::ModelError.
  void check_diameters(std::span<const double> diameters) const;

  /// After bodies have moved, before begin_step(): share of each cell outside them.
  void set_open_fraction(const fluid::CellField& open_fraction);
  /// The same where a body was taken away: the void fraction that is kept is of the same solids in
  /// what is open now, so that the air does not rush in as if they had gone.
  void bodies_changed(const fluid::CellField& open_fraction);

  /// Before the first begin_step(), once: the void fraction round grains that are there at the
  /// start. They push nothing aside in the first fluid step. Throws as begin_step() does.
  void start(const particles::GrainRows& rows);
  /// Throws sdk::ModelError if a grain is too large for the grid.
  [[nodiscard]] AssembledDrag begin_step(const particles::GrainRows& all, double fluid_step);
  [[nodiscard]] const fluid::CellField& void_fraction_before() const;
  [[nodiscard]] const fluid::CellField& void_fraction() const;
  [[nodiscard]] const fluid::Exchange& exchange() const;

  /// `velocity`: what Exchange::coefficient was multiplied by during the fluid step
  /// (FluidSolver::drag_velocity: the mean over sub-steps and stages). `drag` of the last
  /// begin_step(); where both overlap after the last refresh(), else before the first one.
  [[nodiscard]] EvaluatedDrag evaluate(AssembledDrag drag, const particles::GrainRows& grains,
                                       const fluid::FaceField& velocity);
  /// `fluid` as FluidSolver gives it. Halo faces next to the domain are read.
  void refresh(EvaluatedDrag& drag, const particles::GrainRows& grains, const FluidState& fluid);
  /// The same before the fluid has taken its drag: where both overlap.
  void refresh(AssembledDrag& drag, const particles::GrainRows& grains, const FluidState& fluid);
  /// Interval [s] after which refresh() is due again: the fluid step divided by a whole number
  /// (RefreshSchedule). Ask after each begin_step().
  [[nodiscard]] double refresh_interval() const;
  /// Reads fluid_impulse and sets it to zero.
  void end_step(EvaluatedDrag drag, const particles::GrainRows& grains);

  /// Momentum exchange per cell [N/m3], the force on the fluid, 3 per interior cell (x fastest).
  void momentum_exchange(std::vector<float>& per_cell) const;
  [[nodiscard]] const CouplingReport& report() const;

  /// Between end_step() and begin_step().
  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  void deposit(const particles::GrainRows& grains);
  void relax(FaceStencils& stencils, const particles::GrainRows& grains, const FluidState& fluid);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether one of the models gives the hydrostatic buoyancy, so that grains keep their full weight.
bool takes_over_buoyancy(std::span<const std::unique_ptr<sdk::FluidForce>> forces);

}  // namespace dust::coupling

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/force_terms.hpp"
#include "dust/sdk/archive.hpp"
#include "dust/sdk/boundary_condition.hpp"
#include "dust/sdk/drag_law.hpp"
#include "dust/sdk/fluid_force.hpp"
#include "dust/sdk/voidage_rule.hpp"
#include "fluid/grid.hpp"
#include "particles/grain_rows.hpp"
#include "setup/setup.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace dust::coupling {

/// Limiters and checks, counted since the start; none of them is silent.
struct CouplingReport {
  std::int64_t moved_shares = 0;    ///< shares of grain volume given to a neighbour (body, side)
  std::int64_t relieved_cells = 0;  ///< times a cell gave volume away at the smallest void fraction
  std::int64_t unplaced_grains =
      0;  ///< grains with no open cell in reach: their volume is not mapped
  std::int64_t unpaired_forces = 0;   ///< force components with no open face around the grain: the
                                      ///< bodies and sides carry them, not the fluid
  double smallest_void_fraction = 1;  ///< after mapping, since the start
  double largest_imbalance = 0.0;  ///< |impulse on grains + impulse on fluid| / scale, per exchange
  double largest_diameter_over_spacing = 0.0;
};

/// Momentum exchange between grains and fluid. During a fluid step:
///   map()      void fraction of the grains where they are, implicit coefficients for the fluid
///   (the fluid solver advances with exchange())
///   refresh()  several times during the DEM cycle: target velocity and rate of each grain from the
///              fluid at its place; grains integrate drag exactly in between
///   collect()  what the grains really received; the difference to what the fluid was given is
///              handed to the next fluid step, so that the sum over time is exact.
/// The equations and their derivation: docs/theory/coupling.md.
///
/// Where the scenario lets both overlap, the fluid advances while the grains go through their cycle
/// in the fluid of the step before (a copy that the caller keeps); settle() follows both.
///
/// Grains are recognised by their id: rows may be reordered at any time. Insert and remove grains
/// between collect() and map(); one removed earlier takes along what it received in that fluid
/// step.
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

  /// Optional, before the first map(): forces besides drag, and the walls that some of them act at.
  /// The models are kept by reference. With buoyancy among what they take over, the DEM must not
  /// reduce gravity (takes_over_buoyancy).
  void use(std::span<const std::unique_ptr<sdk::FluidForce>> forces,
           std::vector<particles::Surface> surfaces);

  /// Optional: what the sides do to the fluid, null where periodic; without it all others count as
  /// walls. A grain's own flow is another beside them.
  void use_sides(const std::array<const sdk::BoundaryCondition*, 6>& sides);

  /// Optional, before the run: throws base::UserError if a grain of one of the `diameters` [m] is
  /// too large for the grid. map() finds the same later, as sdk::ModelError.
  void check_diameters(std::span<const double> diameters) const;

  /// After bodies have moved, before map(): share of each cell outside them.
  void set_open_fraction(const fluid::CellField& open_fraction);

  /// Before the first map(), once: the void fraction round grains that are there at the start. They
  /// push nothing aside in the first fluid step. Throws as map() does.
  void start(const particles::GrainRows& grains);
  /// Throws sdk::ModelError if a grain is too large for the grid.
  void map(const particles::GrainRows& grains, double fluid_step);
  [[nodiscard]] const fluid::CellField& void_fraction_before() const;
  [[nodiscard]] const fluid::CellField& void_fraction() const;
  [[nodiscard]] const fluid::Exchange& exchange() const;

  /// Tells the velocity that Exchange::coefficient was multiplied by during the fluid step
  /// (FluidSolver::drag_velocity: the mean over sub-steps and stages). Without this call the first
  /// refresh() after map() takes its own velocity, which is exact only for a fluid that takes drag
  /// fully implicitly in one step. Throws std::logic_error once a refresh() has seen the grains
  /// moved since map(), unless both overlap: then it belongs between the last refresh() and
  /// collect().
  void settle(const particles::GrainRows& grains, const fluid::FaceField& velocity);
  /// `velocity` and `stress_divergence` as FluidSolver gives them. Halo faces next to the domain
  /// are read.
  void refresh(const particles::GrainRows& grains, const fluid::FaceField& velocity,
               const fluid::FaceField& stress_divergence);
  /// The same with what forces besides drag look at.
  void refresh(const particles::GrainRows& grains, const FluidState& fluid);
  /// Interval [s] after which refresh() is due again: the fluid step divided by a whole number, 1
  /// to
  /// 64. A quarter of the shortest relaxation time of the grains at the last map(), and at most the
  /// time in which a grain crosses 1/8 of a cell at 2 m/s. Ask after each map().
  [[nodiscard]] double refresh_interval() const;
  /// Reads fluid_impulse and sets it to zero. Throws std::logic_error without a refresh() after
  /// map().
  void collect(const particles::GrainRows& grains, double fluid_step);

  /// Momentum exchange per cell [N/m3], the force on the fluid, 3 per interior cell (x fastest).
  void momentum_exchange(std::vector<float>& per_cell) const;
  [[nodiscard]] const CouplingReport& report() const;

  /// Between collect() and map().
  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether one of the models gives the hydrostatic buoyancy, so that grains keep their full weight.
bool takes_over_buoyancy(std::span<const std::unique_ptr<sdk::FluidForce>> forces);

}  // namespace dust::coupling

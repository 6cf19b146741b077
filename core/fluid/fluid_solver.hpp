// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/archive.hpp"
#include "dust/sdk/boundary_condition.hpp"
#include "dust/sdk/turbulence_model.hpp"
#include "fluid/grid.hpp"
#include "setup/setup.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace dust::fluid {

class ThinBodies;
class VelocityForcing;

/// What the last call of `advance` did.
struct FluidReport {
  int sub_steps = 0;
  int pressure_iterations = 0;  ///< sum over the sub-steps
  double courant_number = 0.0;  ///< largest of a sub-step
  double divergence = 0.0;      ///< largest |d(eps)/dt + div(eps u)| [1/s] after the step
  double largest_speed = 0.0;   ///< [m/s]
};

/// Sides in the order of scenario::k_side_names; null where periodic.
using Boundaries = std::array<const sdk::BoundaryCondition*, 6>;

/// Volume-averaged Navier-Stokes on a staggered grid cut by bodies: incompressible, laminar or with
/// an eddy viscosity,
///   d(eps)/dt + div(eps u) = 0                     docs/theory/fluid.md, eq. (1), (2)
///   rho (du/dt + u . grad u) = -grad p + div tau - coefficient u + source  (Exchange).
/// Bodies that move displace it; bodies with an opening suck it in. Owns velocity and pressure.
/// Deterministic for any number of
/// threads.
class FluidSolver {
 public:
  FluidSolver(const Grid& grid, const scenario::FluidSpec& fluid, const bodies::BodySet& bodies,
              const Boundaries& boundaries);
  ~FluidSolver();
  FluidSolver(const FluidSolver&) = delete;
  FluidSolver& operator=(const FluidSolver&) = delete;

  /// Optional, before the first step: closure of the motion smaller than a cell; kept by reference.
  void use(const sdk::TurbulenceModel& turbulence);
  /// Optional, before the first step: forces that follow from the velocity; kept by reference.
  void use(VelocityForcing& forcing);
  /// [Pa s] per cell, of the last sub-step; null for a laminar fluid.
  [[nodiscard]] const CellField* eddy_viscosity() const;

  /// Advances from `time` by `step` [s]; the void fraction goes from `before` to `after` (padded
  /// cell arrays, interior cells set, 1 in solid cells). Throws sdk::ModelError on divergence.
  void advance(double time, double step, const CellField& before, const CellField& after,
               const Exchange& exchange);

  /// Interstitial velocity; faces inside bodies and halo faces hold the extension that makes linear
  /// interpolation right at the surfaces.
  [[nodiscard]] const FaceField& velocity() const;
  /// What Exchange::coefficient was multiplied by in the last step: drag took the momentum
  /// coefficient * drag_velocity * step from the fluid, per volume and divided by the void
  /// fraction. Meaningful at faces that carry exchange. Not state: valid until the next step only.
  [[nodiscard]] const FaceField& drag_velocity() const;
  /// What grains are to see that move while the next step is solved: drag_velocity() after a step
  /// with drag, else velocity(). With the velocity at the end instead, dust of short relaxation
  /// would stir up air that takes its drag in several sub-steps.
  [[nodiscard]] const FaceField& mean_velocity() const;
  [[nodiscard]] const CellField& pressure() const;
  /// What grains are to see of the pressure: its mean over the last step where they act on one
  /// fluid, else pressure(). Halos are filled after stress_divergence().
  [[nodiscard]] const CellField& mean_pressure() const;
  /// Acceleration-free part -grad p + div tau [N/m3] at faces, of the last step: of its end, or the
  /// mean over it where grains act on one fluid, which then have exactly the part of it that the
  /// fluid was not given. Found when first asked for after a step, which brings the eddies up to
  /// date.
  [[nodiscard]] const FaceField& stress_divergence();
  /// Share of a cell's volume outside all bodies, 0..1 (padded; halo cells as their neighbours).
  [[nodiscard]] const CellField& open_fraction() const;
  /// Share of the faces' areas outside all bodies, mean over the last interval between two cuts
  /// (padded).
  [[nodiscard]] const FaceField& open_area() const;
  /// The same, and nothing where a body thinner than a cell parts two cells: what fluid passes.
  [[nodiscard]] FaceField passable_area() const;
  /// On which side of bodies thinner than a cell a point is, and which faces they part. Stays where
  /// it is when bodies move.
  [[nodiscard]] const ThinBodies& thin_bodies() const;
  /// [m/s] What passed the faces in the last step, over their whole area, as continuity has it:
  /// with the void fraction `after` of that step. The flow is that of its end, but for given flows
  /// that vary in it: their mean, so that what has passed is their integral. Where bodies that move
  /// had the grid cut several times in the step, the mean over it.
  void find_throughflow(FaceField& throughflow);
  /// Calls visit(cell, rate [1/s] of the cell's volume, body) for what bodies drew out of cells in
  /// the last step, its mean.
  void each_sink(const std::function<void(std::int32_t, double, std::int32_t)>& visit) const;
  [[nodiscard]] const FluidReport& report() const;

  /// Do bodies move through the grid, which is then cut anew in each step?
  [[nodiscard]] bool has_moving_bodies() const;
  /// Lets open_fraction() tell of `time` [s], the end of the coming step, so that void fractions
  /// can be made for it. Nothing without moving bodies.
  void look_ahead(double time);
  /// After bodies were taken away: what they filled is fluid at once, without a rush into it.
  void bodies_changed(double time);

  /// Sets the velocity from a function of place (initial conditions, tests) and makes it
  /// consistent.
  void set_velocity(const std::function<sdk::Vec3(sdk::Vec3)>& velocity);

  /// With the stress of the last step, which is found for it.
  void save(sdk::ArchiveWriter& archive);
  /// `time` [s] of the checkpoint: where the bodies are.
  void load(sdk::ArchiveReader& archive, double time);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dust::fluid

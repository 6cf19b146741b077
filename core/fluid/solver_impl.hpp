// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/cut_grid.hpp"
#include "fluid/fluid_solver.hpp"
#include "fluid/momentum/eddy_stress.hpp"
#include "fluid/momentum/momentum.hpp"
#include "fluid/pressure/projection.hpp"
#include "fluid/sides.hpp"
#include "fluid/step/drag_velocity.hpp"
#include "fluid/step/flow_limits.hpp"
#include "fluid/step/step_balance.hpp"
#include "fluid/step/step_void_fraction.hpp"
#include "fluid/step/stress_field.hpp"
#include "fluid/step/two_stages.hpp"
#include "fluid/velocity_forcing.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace dust::fluid {

/// The parts of the solver, and a fluid step made of them (solver_step.cpp):
///   advance        cuts the step where moving bodies make it necessary
///   advance_part   makes the velocity consistent with the grid, then sub-steps by Courant number
///   sub_step       two implicit stages, then the projection
class FluidSolver::Impl {
 public:
  Impl(const Grid& grid, const scenario::FluidSpec& fluid, const bodies::BodySet& bodies,
       const Boundaries& boundaries);

  void use(const sdk::TurbulenceModel& turbulence);
  void use(VelocityForcing& forcing) { stages_.use(forcing); }
  void advance(double time, double step, const CellField& before, const CellField& after,
               const Exchange& exchange);
  void set_velocity(const std::function<sdk::Vec3(sdk::Vec3)>& velocity);
  void bodies_changed(double time);
  void predict_open_fraction(double time) { cut_.predict(time); }

  [[nodiscard]] bool has_moving_bodies() const { return cut_.has_moving_bodies(); }
  [[nodiscard]] const FaceField& velocity() const { return u_; }
  [[nodiscard]] const FaceField& drag_velocity() const { return drag_velocity_.field(); }
  [[nodiscard]] const FaceField& mean_velocity() const {
    return drag_velocity_.is_set() ? drag_velocity_.field() : u_;
  }
  [[nodiscard]] const CellField& pressure() const { return projection_.pressure(); }
  [[nodiscard]] const CellField& mean_pressure() const {
    return balance_.is_kept() ? balance_.mean_pressure() : pressure();
  }
  [[nodiscard]] const CellField& open_fraction() const { return cut_.open_fraction(); }
  [[nodiscard]] const FaceField& open_area() const { return geometry().open_area; }
  [[nodiscard]] const ThinBodies& thin_bodies() const { return cut_.thin_bodies(); }
  [[nodiscard]] FaceField passable_area() const { return fluid::passable_area(grid_, geometry()); }
  void find_throughflow(FaceField& throughflow) {
    projection_.find_throughflow(u_, void_fraction_.field(), throughflow);
  }
  [[nodiscard]] std::vector<Continuity::Sink> mean_sinks() const {
    return projection_.mean_sinks();
  }
  [[nodiscard]] const FluidReport& report() const { return report_; }
  [[nodiscard]] const CellField* eddy_viscosity() const {
    return eddies_ ? &eddies_->eddy_viscosity() : nullptr;
  }
  const FaceField& stress_divergence() {
    return stress_.of_flow(u_, projection_.pressure(), eddies_.get());
  }

  void save(sdk::ArchiveWriter& archive);
  void load(sdk::ArchiveReader& archive, double time);

 private:
  /// A fluid step: what is given, and what follows from it for all its parts.
  struct StepState {
    double time;  ///< [s] at its beginning
    double step;  ///< [s]
    const CellField& before;
    const CellField& after;
    const Exchange& exchange;
    bool is_clean;    ///< no solids anywhere
    bool has_drag;    ///< the exchange has coefficients
    bool keeps_mean;  ///< the mean velocity of its stages is asked for
  };

  [[nodiscard]] StepState begin_step(double time, double step, const CellField& before,
                                     const CellField& after, const Exchange& exchange);
  double advance_part(const StepState& s, double begin, double end);
  void begin_part(const StepState& s, double begin, double end);
  void make_consistent(const StepState& s);
  void sub_step(const StepState& s, double time, double step, double speed);
  void end_step(const StepState& s, double last_share);

  void recut(double begin, double end);
  void set_void_fraction(const StepState& s, double share);
  [[nodiscard]] bool has_coefficient(const Exchange& exchange) const;
  [[nodiscard]] const Geometry& geometry() const { return cut_.geometry(); }
  [[nodiscard]] ForcedFluid forced_fluid() const { return {geometry(), void_fraction_.field()}; }

  Grid grid_;
  Sides sides_;
  FaceProperties properties_;
  CutGrid cut_;
  Momentum momentum_;
  Projection projection_;
  FaceField u_;
  TwoStages stages_;
  StepVoidFraction void_fraction_;
  DragVelocity drag_velocity_;
  StepBalance balance_;
  std::unique_ptr<EddyStress> eddies_;  ///< null: laminar
  StressField stress_;                  ///< of the last step
  FlowLimits limits_;
  FluidReport report_;
};

}  // namespace dust::fluid

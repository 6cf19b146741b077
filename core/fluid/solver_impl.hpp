// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/cached.hpp"
#include "fluid/cut_grid.hpp"
#include "fluid/drag_velocity.hpp"
#include "fluid/fluid_solver.hpp"
#include "fluid/momentum/eddy_stress.hpp"
#include "fluid/momentum/momentum.hpp"
#include "fluid/momentum/momentum_balance.hpp"
#include "fluid/pressure/continuity.hpp"
#include "fluid/sides.hpp"
#include "fluid/step_void_fraction.hpp"
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
  void use(VelocityForcing& forcing) { forcing_ = &forcing; }
  void advance(double time, double step, const CellField& before, const CellField& after,
               const Exchange& exchange);
  void set_velocity(const std::function<sdk::Vec3(sdk::Vec3)>& velocity);
  void bodies_changed(double time);
  void predict_open_fraction(double time) { cut_.predict(time); }

  [[nodiscard]] bool has_movers() const { return cut_.has_movers(); }
  [[nodiscard]] const FaceField& velocity() const { return u_; }
  [[nodiscard]] const FaceField& drag_velocity() const { return drag_velocity_.field(); }
  [[nodiscard]] const FaceField& mean_velocity() const {
    return drag_velocity_.is_set() ? drag_velocity_.field() : u_;
  }
  [[nodiscard]] const CellField& pressure() const { return p_; }
  [[nodiscard]] const CellField& mean_pressure() const {
    return is_balanced_ ? mean_pressure_ : p_;
  }
  [[nodiscard]] const CellField& open_fraction() const { return cut_.open_fraction(); }
  [[nodiscard]] const FaceField& open_area() const { return geometry().open_area; }
  void find_throughflow(FaceField& throughflow) const {
    continuity_.find_throughflow(u_, void_fraction_.field(), throughflow);
  }
  [[nodiscard]] const std::vector<Continuity::Sink>& sinks() const { return continuity_.sinks(); }
  [[nodiscard]] const FluidReport& report() const { return report_; }
  [[nodiscard]] const CellField* eddy_viscosity() const {
    return eddies_ ? &eddies_->eddy_viscosity() : nullptr;
  }
  const FaceField& stress_divergence();

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
    bool is_clean;     ///< no solids anywhere
    bool has_drag;     ///< the exchange has coefficients
    bool is_balanced;  ///< its momentum is kept book of
    bool keeps_mean;   ///< the mean velocity of its stages is asked for
  };
  /// A part of it.
  struct SubStep {
    double time;        ///< [s]
    double step;        ///< [s]
    double share;       ///< [-] of the fluid step
    double smoothness;  ///< [m2/s2] as Momentum::convection_row
  };
  [[nodiscard]] ForcedFluid forced_fluid() const { return {geometry(), void_fraction_.field()}; }
  [[nodiscard]] static ForcedPart forced(const StepState& s, const SubStep& part) {
    return {part.time + part.step - s.time, part.step, part.share};
  }
  /// Fields of the two stages.
  struct Stages {
    FaceField next, right, sum;
  };

  [[nodiscard]] StepState begin_step(double time, double step, const CellField& before,
                                     const CellField& after, const Exchange& exchange);
  double advance_part(const StepState& s, double begin, double end);
  void begin_part(const StepState& s, double begin, double end);
  void make_consistent(const StepState& s, double time);
  void find_first_pressure(const StepState& s, double time);
  [[nodiscard]] int parts_of(const StepState& s, double left, const Momentum::Rates& rates) const;
  void sub_step(const StepState& s, const SubStep& part);
  void project(const StepState& s, const SubStep& part);
  void convect(const StepState& s, const SubStep& part, const FaceField& v,
               const FaceField* add_to);
  void solve_stage();
  void end_step(const StepState& s, double last_share);

  void recut(double begin, double end);
  void begin_balance(const StepState& s);
  void balance_convection(const FaceField& v, int d, int j, int k, const double* row, double time);
  void find_stress(const FaceField& v, CellField& pressure, FaceField& stress,
                   const FaceField* eddies);
  void set_void_fraction(const StepState& s, double share);
  [[nodiscard]] bool is_uniform(const std::vector<double>& field, const std::array<int, 3>& n,
                                double value);
  [[nodiscard]] bool has_coefficient(const Exchange& exchange);
  void check_finite(double time, const Momentum::Rates& rates) const;
  /// Halos as far as the steps themselves need them.
  void fill_stage(FaceField& v) const {
    eddies_ ? sides_.fill_velocity(v) : sides_.fill_varying(v);
  }
  /// Calls body(d, index of the first face, faces, 1 / spacing) for the rows of all components that
  /// may move.
  template <class Body>
  void each_moving_row(const Body& body) const;
  [[nodiscard]] const Geometry& geometry() const { return cut_.geometry(); }
  const FaceField& no_drag();

  Grid grid_;
  scenario::FluidSpec fluid_;
  Sides sides_;
  FaceProperties properties_;
  CutGrid cut_;
  Momentum momentum_;
  Continuity continuity_;
  FaceField u_;
  CellField p_;
  Stages stages_;
  StepVoidFraction void_fraction_;
  DragVelocity drag_velocity_;
  std::unique_ptr<MomentumBalance> balance_;  ///< once there were particles
  CellField mean_pressure_;                   ///< over the last step, if that was balanced
  std::unique_ptr<EddyStress> eddies_;        ///< null: laminar
  VelocityForcing* forcing_ = nullptr;        ///< null: none
  Cached<FaceField> stress_;                  ///< of the last step
  Cached<Momentum::Rates> rates_;             ///< of u_
  FaceField zero_;                            ///< empty until it is needed
  std::vector<double> partial_;
  bool is_balanced_ = false;    ///< the momentum of the last step
  bool is_consistent_ = false;  ///< u_ obeys continuity
  FluidReport report_;
};

}  // namespace dust::fluid

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/body_suction.hpp"
#include "fluid/continuity.hpp"
#include "fluid/eddy_stress.hpp"
#include "fluid/fluid_solver.hpp"
#include "fluid/geometry.hpp"
#include "fluid/momentum.hpp"
#include "fluid/momentum_book.hpp"
#include "fluid/sides.hpp"

#include <array>
#include <memory>
#include <vector>

namespace dust::fluid {

/// State of the solver. solver_step.cpp: one fluid step. solver_bodies.cpp: the grid as bodies cut
/// it, and what moving ones do to continuity.
struct FluidSolver::Impl {
  Impl(const Grid& g, const scenario::FluidSpec& f, const bodies::BodySet& b,
       const Boundaries& boundaries);

  /// The geometry of the bodies that stand, if there are others.
  [[nodiscard]] std::unique_ptr<Geometry> standing_part() const;
  /// What follows from the bodies' places at `time`.
  void complete_geometry(double time);
  void evaluate_walls(double time);
  /// Faces deep in bodies, in both fields that take turns in holding the velocity.
  void set_deep_ghosts();
  /// Cuts the grid by the bodies as they move over the interval.
  void cut_anew(double begin, double end);
  /// Intervals in which the grid is cut anew over `step`.
  [[nodiscard]] int cuts_per_step(double step) const;
  /// d(theta eps)/dt of cells over an interval of a fluid step, from shares `from` to `to` of it.
  void set_rate(const CellField& before, const CellField& after, double from, double to,
                double step);
  /// What a cell that has closed still held goes to the widest open neighbour.
  void hand_on_closed(CellField& rate) const;
  /// Is the number everywhere in the rows of cells (of faces along d) that of `value`?
  [[nodiscard]] bool is_uniform(const std::vector<double>& field, const std::array<int, 3>& n,
                                double value);
  [[nodiscard]] bool has_coefficient(const Exchange& exchange);
  void set_eps(const CellField& before, const CellField& after, double share);
  void check_finite(double time, const Momentum::Rates& r) const;
  void convect(const FaceField& v, double smoothness, const FaceField* add_to, double step);
  /// Adds what drag acted on in a stage of weight `share` of the whole fluid step.
  void add_drag_velocity(const FaceField& stage, double share);
  void add_pressure_drag(double step, const FaceField& drag, double share);
  /// `share`: of this sub-step in the whole fluid step.
  void sub_step(double time, double step, double share, double speed, const Exchange& exchange);
  /// The pressure that keeps the present velocity free of divergence under the sides' pressures and
  /// the sources: else these would act in the first step as a blow that nothing holds.
  void find_first_pressure(double time, double step, const Exchange& exchange);
  /// The source with the stress of the eddies of the present velocity.
  const FaceField& with_eddies(const FaceField& source);
  /// Solves for `next` with the sides' present values and completes it.
  void solve_stage();
  /// Halos as far as the steps themselves need them.
  void fill_stage(FaceField& v) const { eddies ? sides.fill_velocity(v) : sides.fill_varying(v); }
  void find_stress();
  /// stress = -grad pressure + div tau of the velocity `v`, halos filled.
  void find_stress_of(const FaceField& v, CellField& pressure);
  /// Whether this step's momentum is booked: where grains act on one fluid without eddies, whose
  /// grid stays.
  [[nodiscard]] bool keeps_book() const {
    return has_drag && !eddies && !standing && properties.by_place().is_uniform();
  }
  /// Adds a row's convection of this stage to the book.
  void book_convection(const FaceField& v, int d, int j, int k, const double* row, double time);
  void begin_book(const CellField& before, const CellField& after, const Exchange& exchange,
                  double step);
  void end_book(const Exchange& exchange, double step, double last);
  void advance(double time, double step, const CellField& before, const CellField& after,
               const Exchange& exchange);
  /// From the shares `begin` to `end` of a fluid step, between two cuts of the grid.
  void advance_part(double time, double step, double begin, double end, const CellField& before,
                    const CellField& after, const Exchange& exchange);
  const FaceField& no_drag();

  Grid grid;
  scenario::FluidSpec fluid;
  const bodies::BodySet& bodies;
  Sides sides;
  FaceProperties properties;
  std::unique_ptr<Geometry> standing;  ///< only if bodies move
  Geometry geometry;
  BodySuction suction;
  Momentum momentum;
  Continuity continuity;
  FaceField u;
  FaceField next;
  FaceField right;
  FaceField sum;
  FaceField stress;
  FaceField drag_velocity;
  std::unique_ptr<MomentumBook> book;  ///< once there were grains
  CellField mean_pressure;             ///< over the last step, if that was booked
  FaceField zero;
  CellField p;
  CellField eps;
  CellField open_before;  ///< open fractions at the beginning of the interval between two cuts
  CellField open_ahead;   ///< what open_fraction() tells
  std::unique_ptr<EddyStress> eddies;  ///< null: laminar
  FaceField all_sources;
  std::vector<double> partial;
  Momentum::Rates rates;  ///< of u at the end of the last step
  bool rates_are_known = false;
  bool stress_is_known = true;
  bool drag_velocity_is_set = false;
  bool has_drag = false;    ///< in this step
  bool is_booked = false;   ///< the momentum of this step
  double last_share = 1.0;  ///< of the last sub-step in its step
  bool is_clean = false;    ///< no solids anywhere in this step
  bool eps_is_one = false;  ///< now, halos included
  bool walls_have_changed = true;
  bool is_consistent = false;
  FluidReport report;
};

}  // namespace dust::fluid

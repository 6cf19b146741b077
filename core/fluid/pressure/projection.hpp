// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/cut_grid.hpp"
#include "fluid/face_properties.hpp"
#include "fluid/grid.hpp"
#include "fluid/momentum/momentum.hpp"
#include "fluid/pressure/continuity.hpp"
#include "fluid/pressure/ghost_pressure.hpp"
#include "fluid/sides.hpp"
#include "fluid/step/time_mean.hpp"

#include <vector>

namespace dust::fluid {

/// The pressure, and the projections that make a velocity obey continuity and change it:
/// docs/theory/fluid.md, eq. (6).
class Projection {
 public:
  /// References are kept.
  Projection(const Grid& grid, const CutGrid& cut, Sides& sides, const FaceProperties& properties,
             const Momentum& momentum, double tolerance);

  [[nodiscard]] CellField& pressure() { return p_; }
  [[nodiscard]] const CellField& pressure() const { return p_; }
  [[nodiscard]] Continuity& continuity() { return continuity_; }
  [[nodiscard]] const Continuity& continuity() const { return continuity_; }
  /// After the grid was cut anew.
  void geometry_changed() {
    continuity_.geometry_changed(p_);
    ghost_pressure_.find(grid_, cut_.geometry(), continuity_.pattern());
  }

  /// Of the solver, since begin_step().
  [[nodiscard]] int iterations() const { return iterations_; }
  void begin_step(Interval step) {
    iterations_ = 0;
    step_ = step;
    mean_throughflow_ = {};
    mean_sinks_.clear();
  }
  /// What passes the faces over an interval between two cuts, `share` of the step; for steps of
  /// several.
  void add_throughflow(const FaceField& u, const CellField& eps, Interval part, double share);
  /// What passes the faces over the step, `u` being the velocity at its end, so that it obeys
  /// continuity from its beginning to its end: that of the end, with the mean of given flows that
  /// vary in the step; in a step of several cuts the mean over them.
  void find_throughflow(const FaceField& u, const CellField& eps, FaceField& throughflow);
  /// What bodies draw out of cells over the step.
  [[nodiscard]] std::vector<Continuity::Sink> mean_sinks() const;

  /// Makes the velocity `u`, of the end of `step` [s] at `time` [s], obey continuity, and adds the
  /// increment to the pressure. `is_plain` as Continuity::project.
  void project(FaceField& u, const CellField& eps, const FaceField& drag, bool is_plain,
               double step, double time);

  /// Whether the velocity obeys continuity, as that of the start may not.
  [[nodiscard]] bool is_consistent() const { return is_consistent_; }
  void set_consistent(bool is_consistent) { is_consistent_ = is_consistent; }
  /// Makes a velocity that does not obey continuity do so, with halos filled; then finds the
  /// pressure that keeps it so under the sides' pressures and `source`: else these would act in the
  /// first step as a blow that nothing holds. `scratch` is overwritten.
  void make_consistent(FaceField& u, FaceField& scratch, const CellField& eps,
                       const FaceField& source, double step, double time);

 private:
  void find_part_throughflow(const FaceField& u, const CellField& eps, Interval part,
                             FaceField& throughflow);
  void correct(FaceField& u, const CellField& eps, double step);
  void find_first_pressure(const FaceField& u, FaceField& next, const CellField& eps,
                           const FaceField& source, double step, double time);

  const Grid& grid_;
  const CutGrid& cut_;
  Sides& sides_;
  const FaceProperties& properties_;
  const Momentum& momentum_;
  double tolerance_;
  Continuity continuity_;
  GhostPressure ghost_pressure_;
  CellField p_;                               ///< [Pa]
  FaceField zero_;                            ///< no drag; empty until it is needed
  FaceField mean_throughflow_;                ///< [m/s] empty in steps of one cut
  std::vector<Continuity::Sink> mean_sinks_;  ///< of the cells of each cut, in such steps
  Interval step_;                             ///< [s] the last one
  int iterations_ = 0;
  bool is_consistent_ = false;
};

}  // namespace dust::fluid

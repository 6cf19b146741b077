// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "fluid/face_properties.hpp"
#include "fluid/geometry/body_suction.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/geometry/thin_bodies.hpp"
#include "fluid/grid.hpp"
#include "fluid/pressure/continuity.hpp"
#include "fluid/sides.hpp"

#include <memory>
#include <vector>

namespace dust::fluid {

/// The grid as bodies cut it, and what those that move do to continuity.
class CutGrid {
 public:
  /// All are kept by reference. complete() follows.
  CutGrid(const Grid& grid, const bodies::BodySet& bodies, const Sides& sides,
          const FaceProperties& properties);

  /// Stays where it is when it is built anew.
  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] const bodies::BodySet& bodies() const { return bodies_; }
  [[nodiscard]] const ThinBodies& thin_bodies() const { return thin_bodies_; }
  /// Do bodies move through the grid, which is then cut anew in each step?
  [[nodiscard]] bool has_moving_bodies() const { return static_geometry_ != nullptr; }
  /// Share of the cells outside bodies, as it will be once predict() was called.
  [[nodiscard]] const CellField& open_fraction() const { return open_ahead_; }
  /// Intervals in which the grid is cut anew over `step` [s].
  [[nodiscard]] int intervals(double step) const;

  /// After bodies were taken away, before cut().
  void bodies_changed();
  /// Cuts the grid by the bodies as they move from `begin` to `end` [s].
  void cut(double begin, double end);
  /// Halos, openings and surfaces of what was cut, at `time` [s].
  void complete(double time);
  /// The surfaces' velocities at `time`.
  void evaluate_walls(double time);
  /// The open fractions at `time`, while the grid stays; nothing without movers.
  void predict(double time);
  /// The walls' velocities are to be taken over, whatever they were.
  void walls_have_changed() { have_walls_changed_ = true; }

  /// Faces deep in bodies, in both fields that take turns in holding the velocity.
  void set_deep_ghosts(FaceField& u, FaceField& next);
  /// d(theta eps)/dt of cells from the shares `from` to `to` of a fluid step of `step` [s].
  void set_rate(const CellField& before, const CellField& after, double from, double to,
                double step, Continuity& continuity) const;
  void set_sinks(std::vector<Continuity::Sink>& sinks, double time) const {
    suction_.set_sinks(sinks, time);
  }
  void set_mean_sinks(std::vector<Continuity::Sink>& sinks, Interval over) const {
    suction_.set_mean_sinks(sinks, over);
  }

 private:
  [[nodiscard]] std::unique_ptr<Geometry> static_part() const;
  void set_static_rate(const CellField& before, const CellField& after, double step,
                       CellField& rate) const;
  void redistribute_closed(const Continuity& continuity, CellField& rate) const;

  const Grid& grid_;
  const bodies::BodySet& bodies_;
  const Sides& sides_;
  const FaceProperties& properties_;
  std::unique_ptr<Geometry> static_geometry_;  ///< of the bodies that stand, if others move
  Geometry geometry_;
  BodySuction suction_;
  ThinBodies thin_bodies_;
  CellField open_before_;  ///< at the beginning of the interval between two cuts
  CellField open_ahead_;
  bool have_walls_changed_ = true;
};

}  // namespace dust::fluid

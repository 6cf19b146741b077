// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/shape.hpp"
#include "dust/sdk/vec3.hpp"

#include <limits>

namespace dust::bodies {

/// All lengths in m.
struct CleatParameters {
  double length = 0.0;      ///< between the pulley axes
  double reach = 0.0;       ///< of the belt's middle surface, from the pulley's axis
  double half_width = 0.0;  ///< of the belt
  double top = 0.0;         ///< over the middle surface
  double thickness = 0.0;   ///< along the belt
  double spacing = 0.0;     ///< wanted; made such that a whole number goes round the belt
};

/// Crossbars on a flat belt round two pulleys: rigid boxes that stand on its middle surface, square
/// to it at their middle. They run with it: on the runs they shift, round the pulleys they turn
/// about the pulley's axis.
///
/// Coordinates: x along the belt from the head pulley's axis (negative before it), y across, z up
/// from the axis. The way s round the belt begins over the head pulley's axis; cleat k is at
/// k spacing() + run. docs/theory/conveyors.md, eq. (5).
class Cleats {
 public:
  explicit Cleats(const CleatParameters& p);
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double spacing() const { return spacing_; }
  /// Distance of the farthest corner from a pulley's axis.
  [[nodiscard]] double tip_radius() const;

  /// Where one of them stands.
  struct Stand {
    sdk::Vec3 base;   ///< on the middle surface
    sdk::Vec3 along;  ///< unit, the way it runs
    sdk::Vec3 out;    ///< unit, from base to top
    bool is_on_pulley = false;
    double pulley = 0.0;  ///< x of its axis
  };
  struct Nearest {
    SurfacePoint point;
    Stand stand;
  };
  /// Those that are not nearer than `limit` [m] may be left out: then the distance is `limit`.
  [[nodiscard]] Nearest nearest(double run, sdk::Vec3 q,
                                double limit = std::numeric_limits<double>::infinity()) const;
  /// Of those between two places along the belt.
  [[nodiscard]] Triangles triangles(double run, double from, double to) const;

 private:
  [[nodiscard]] Stand stand_at(double way) const;
  [[nodiscard]] SurfacePoint box(const Stand& stand, sdk::Vec3 q) const;

  CleatParameters p_;
  double half_round_ = 0.0;  ///< [m] way round a pulley
  double lap_ = 0.0;         ///< [m] round the belt
  int count_ = 0;
  double spacing_ = 0.0;
};

}  // namespace dust::bodies

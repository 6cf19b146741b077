// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

namespace dust::bodies {

/// What makes the carrying run of a belt: its middle surface between the tangent lines of both
/// pulleys. All lengths in m.
struct TroughParameters {
  double length = 0.0;       ///< between the pulley axes
  double half_width = 0.0;   ///< of the belt
  double half_centre = 0.0;  ///< of the centre roll
  double bend = 0.0;   ///< from where a centre roll and a wing roll would meet to where the belt
                       ///< leaves either: the belt bends smoothly in between
  double slope = 0.0;  ///< tan(trough angle / 2)
  double head_transition = 0.0;  ///< from the last troughed section to the head pulley
  double tail_transition = 0.0;
  double rise = 0.0;  ///< of the pulleys over the line of the centre rolls
  double sag = 0.0;   ///< of the belt midway between two idlers
  double idler_spacing = 0.0;
};

/// The middle surface of a carrying run, as a family of cross-sections: flat on the centre roll,
/// straight on both wing rolls, a round bend between them. In the transitions the trough angle
/// falls smoothly to 0. The belt keeps its width in every section.
///
/// Coordinates: x along the run (0 at the head pulley's axis, negative before it), y across, z from
/// the line of the pulleys' tops. docs/theory/conveyors.md, eq. (1), (2), (3), (4).
class Trough {
 public:
  explicit Trough(const TroughParameters& p);

  /// The point of the surface nearest to `point`.
  [[nodiscard]] sdk::Vec3 foot(sdk::Vec3 point) const;
  /// A point of the section at `x`: `across` [m] is measured along the belt, from its middle.
  [[nodiscard]] sdk::Vec3 at(double x, double across) const;
  /// The unit vector along which the belt runs at a point of the surface.
  [[nodiscard]] sdk::Vec3 running_direction(sdk::Vec3 foot) const;
  [[nodiscard]] const TroughParameters& parameters() const { return p_; }
  /// A point seen from the section at `x`, in the section's plane.
  struct Seen {
    double over = 0.0;  ///< [m] along `normal` from its foot, negative below the belt
    double past_edge =
        0.0;              ///< [m] along `side` from the belt's edge; inside as far as its wing goes
    sdk::Vec3 normal;     ///< unit, at its foot, to the carrying side
    sdk::Vec3 side;       ///< unit, along the belt at its foot, to the edge that is nearer
    double across = 0.0;  ///< [m] of its foot, along the belt from its middle, as of at()
  };
  [[nodiscard]] Seen seen_from(double x, double y, double z) const;
  /// A point `over` the belt's middle surface in the section at `x`, along its normal there.
  [[nodiscard]] sdk::Vec3 at(double x, double across, double over) const;
  /// Whether all sections from one place to another are the same.
  [[nodiscard]] bool is_even(double from, double to) const;

 private:
  /// The section at one place along the run.
  struct Section {
    double slope = 0.0;         ///< tan(angle / 2)
    double slope_change = 0.0;  ///< [1/m] along the run
    double height = 0.0;        ///< [m] of the centre
    double height_change = 0.0;
    double sine = 0.0, cosine = 1.0;  ///< of the trough angle
    double radius = 0.0;              ///< [m] of the bend, 0 = flat throughout
  };
  /// The nearest point of a section in its plane and how it moves with x: the velocity of the point
  /// along the line to what it is nearest to, times the distance.
  struct SectionFoot {
    double y = 0.0, z = 0.0;
    double pull = 0.0;  ///< [m]
  };
  [[nodiscard]] Section section(double x) const;
  [[nodiscard]] Section measured(double x) const;
  [[nodiscard]] SectionFoot nearest_in(const Section& s, double y, double z) const;
  [[nodiscard]] double best_start(sdk::Vec3 point, double nearest) const;
  [[nodiscard]] double wing_end(double slope) const;
  [[nodiscard]] double wing_end_rate(double slope) const;

  TroughParameters p_;
  Section full_;  ///< between the transitions, without sag
};

}  // namespace dust::bodies

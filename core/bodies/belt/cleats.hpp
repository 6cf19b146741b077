// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/belt/bar_section.hpp"
#include "bodies/belt/trough.hpp"
#include "bodies/shape.hpp"
#include "dust/sdk/vec3.hpp"

#include <limits>
#include <optional>
#include <vector>

namespace dust::bodies {

/// All lengths in m.
struct CleatParameters {
  double length = 0.0;      ///< between the pulley axes
  double reach = 0.0;       ///< of the belt's middle surface, from the pulley's axis
  double half_width = 0.0;  ///< of the belt
  double face = 0.0;        ///< of the belt, over its middle surface
  double height = 0.0;      ///< over the face
  double thickness = 0.0;   ///< along the belt
  double spacing = 0.0;     ///< wanted; made such that a whole number goes round the belt
  BarSection::Profile profile = BarSection::Profile::bar;
  std::optional<Trough> trough = std::nullopt;  ///< of the carrying run where that is not flat
};

/// Crossbars on a belt round two pulleys. On a flat belt they are rigid and stand on its middle
/// surface, square to it at their middle: on the runs they shift, round the pulleys they turn about
/// the pulley's axis. On the carrying run of a troughed belt each fits the section it is at: a
/// strip of that section, as high everywhere along the section's normal; in the transitions it
/// bends with the belt.
///
/// Round ones may be so near to each other that a grain lies between two of them. They are in two
/// rows, every other one, so that it touches one of each. Those that touch each other make the
/// belt's surface a wave: they are as thick as they are apart.
///
/// Coordinates: x along the belt from the head pulley's axis (negative before it), y across, z up
/// from the axis. The way s round the belt begins over the head pulley's axis; cleat k of a row is
/// at k spacing() + run, those of a second row gap() farther. docs/theory/conveyors.md, eq. (5).
class Cleats {
 public:
  explicit Cleats(const CleatParameters& p);
  [[nodiscard]] int count() const { return count_; }  ///< of all rows
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] double gap() const { return gap_; }              ///< [m] from one to the next
  [[nodiscard]] double spacing() const { return rows_ * gap_; }  ///< [m] in a row
  [[nodiscard]] double thickness() const { return p_.thickness; }
  /// Distance of the farthest corner from a pulley's axis.
  [[nodiscard]] double tip_radius() const;

  /// Where one of them stands.
  struct Stand {
    sdk::Vec3 base;   ///< on the middle surface
    sdk::Vec3 along;  ///< unit, the way it runs
    sdk::Vec3 out;    ///< unit, from base to top
    bool is_on_pulley = false;
    double pulley = 0.0;        ///< x of its axis
    bool is_in_trough = false;  ///< `base` and `out` are those of a flat run
  };
  struct Nearest {
    SurfacePoint point;
    Stand stand;
  };
  /// Of a row, from 0. Those that are not nearer than `limit` [m] may be left out: then the
  /// distance is `limit`.
  [[nodiscard]] Nearest nearest(double run, int row, sdk::Vec3 q,
                                double limit = std::numeric_limits<double>::infinity()) const;
  /// Of those between two places along the belt; those in a trough with corners at `widths` across.
  [[nodiscard]] Triangles triangles(double run, double from, double to,
                                    const std::vector<double>& widths) const;
  /// How a point of a cleat that is in the trough moves, over the belt's speed: eq. (6) there.
  [[nodiscard]] sdk::Vec3 velocity_in_trough(const Stand& stand, sdk::Vec3 q) const;
  /// Speed of the fastest point over the belt's.
  [[nodiscard]] double largest_factor() const;

 private:
  [[nodiscard]] SurfacePoint strip(const Stand& stand, sdk::Vec3 q) const;
  void look_in_trough(double run, sdk::Vec3 q, Nearest& best) const;
  void draw_in_trough(Triangles& t, const Stand& stand,
                      const std::vector<BarSection::Point>& outline,
                      const std::vector<double>& widths) const;
  [[nodiscard]] Stand stand_at(double way) const;
  [[nodiscard]] SurfacePoint straight(const Stand& stand, sdk::Vec3 q) const;

  CleatParameters p_;
  double half_round_ = 0.0;  ///< [m] way round a pulley
  double lap_ = 0.0;         ///< [m] round the belt
  int rows_ = 1;
  int count_ = 0;
  double gap_ = 0.0;
  double top_ = 0.0;  ///< [m] over the middle surface
  BarSection section_;
  double lowest_ = 0.0;   ///< [m] of a trough's cleats, from the line of the pulleys' tops
  double highest_ = 0.0;  ///< [m]
};

}  // namespace dust::bodies

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/vec3.hpp"
#include "fluid/grid.hpp"

#include <limits>
#include <optional>
#include <vector>

namespace dust::fluid {

/// The bodies at one instant as the grid sees them: distances, shares, what lies between points.
class BodyField {
 public:
  struct Hit {
    double distance = std::numeric_limits<double>::max();  ///< [m] negative inside
    sdk::Vec3 normal;
    int body = -1;
  };
  enum class Which { all, static_bodies };  ///< standing: those that never change their place

  BodyField(const Grid& grid, const bodies::BodySet& bodies, double time, Which which);

  [[nodiscard]] bool is_empty() const { return static_bodies_.empty() && moving_bodies_.empty(); }
  [[nodiscard]] bool has_moving_bodies() const { return !moving_bodies_.empty(); }
  [[nodiscard]] Hit nearest(sdk::Vec3 p) const;
  /// Whether all that moves is farther from p than `reach` [m].
  [[nodiscard]] bool is_far_from_moving_bodies(sdk::Vec3 p, double reach) const;
  [[nodiscard]] bool is_inside(sdk::Vec3 p) const;

  /// Share of the box (edges `size`, 0 = flat) outside all bodies. Within a sub-box the surface is
  /// taken as a plane that meets it in proportion to the distance: exact for planes along the grid.
  /// `middle` receives the middle of the open part. `smear` [s] widens the plane by its way in that
  /// time: the mean over it.
  [[nodiscard]] double open_share(sdk::Vec3 centre, sdk::Vec3 size, sdk::Vec3* middle = nullptr,
                                  double smear = 0.0) const;
  /// Distance from `from` (outside) to the surface on the way to `to` (inside).
  [[nodiscard]] double wall_distance(sdk::Vec3 from, sdk::Vec3 to) const;

  /// A point of the fluid that stands for the box round `centre`: the centre, or the point beside
  /// the nearest surface if the centre is in a body; nothing if that is in another one.
  [[nodiscard]] std::optional<sdk::Vec3> outside(sdk::Vec3 centre) const;
  /// Where the way from `from` to `to`, both in the fluid, meets a body that it passes through: one
  /// thinner than the way. Nothing where it is free or only grazes a body, as a chord of a round
  /// one does.
  [[nodiscard]] std::optional<double> passes_through(sdk::Vec3 from, sdk::Vec3 to) const;

 private:
  /// A body, or a part of one that moves in part alone.
  struct Placed {
    const bodies::Body* body;
    int number;
    bodies::Placement at;
    int part = k_whole;
    /// A part that is not nearer than `limit` [m] may be told as infinitely far.
    [[nodiscard]] bodies::SurfacePoint nearest(sdk::Vec3 p, double limit) const;
  };
  static constexpr int k_whole = -1;
  /// How far the surface goes along its normal in `smear` [s].
  [[nodiscard]] double own_way(const Hit& hit, sdk::Vec3 p, double smear) const;
  /// Share of the sub-box of edges `size` round p that is open, by the plane of the surface at
  /// hand.
  [[nodiscard]] double open_part(const Hit& hit, sdk::Vec3 p, sdk::Vec3 size, double smear) const;
  /// The bodies that may be nearest to a point within `reach` of p, in the order of nearest(): of
  /// many, all of them.
  class Near;
  /// On a surface.
  struct Place {
    sdk::Vec3 point, normal;
  };
  [[nodiscard]] bool leads_round(const Near& near, const Place& in, const Place& out) const;
  [[nodiscard]] bool is_free(const Near& near, sdk::Vec3 from, sdk::Vec3 to) const;
  [[nodiscard]] sdk::Vec3 away(const Near& near, sdk::Vec3 place) const;
  /// What a straight way from a place in the fluid meets.
  struct Met {
    enum class End { free, surface, unknown };
    End end = End::free;
    double way = 0.0;  ///< [m] to there
    Hit hit;
  };
  [[nodiscard]] Met meet(const Near& near, sdk::Vec3 from, sdk::Vec3 to, int steps_left) const;

  std::vector<Placed> static_bodies_;
  std::vector<Placed> moving_bodies_;
  double smallest_ = 0.0;       ///< [m] spacing that lengths are compared with
  double largest_speed_ = 0.0;  ///< [m/s] of the surfaces that go to other places
};

}  // namespace dust::fluid

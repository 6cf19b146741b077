// SPDX-License-Identifier: Apache-2.0
#include "fluid/geometry/body_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::fluid {
namespace {

using sdk::Vec3;

/// A point this close to a surface (in cells) counts as being on it, so inside the body.
constexpr double k_on_surface = 1e-6;
/// Openings smaller than this are closed, larger than one minus this are whole.
constexpr double k_min_opening = 1e-4;
/// Sub-boxes per direction in which an open share is measured.
constexpr int k_sub_boxes = 8;
/// Distance from a surface (in cells) of the points that stand for cells with their centre inside.
constexpr double k_beside = 1e-3;
/// Share of the distance that a step goes: a sheet is met on the side one comes from.
constexpr double k_stride = 0.99;
/// Steps after which the way along a surface counts as free: each is as long as the distance.
constexpr int k_max_steps = 200;

}  // namespace

BodyField::BodyField(const Grid& grid, const bodies::BodySet& bodies, double time, Which which) {
  for (int d = 0; d < 3; ++d) {
    const double h = grid.spacing[d];
    if (grid.count[d] > 1 && (smallest_ == 0.0 || h < smallest_)) smallest_ = h;
  }
  if (smallest_ == 0.0) smallest_ = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const bodies::Body& body = bodies[b];
    if (body.is_removed()) continue;
    const bool is_moving = body.displaces();
    if (is_moving && which == Which::static_bodies) continue;
    // A surface that only moves along itself stays where the scenario puts it, to the last bit.
    const auto at =
        is_moving ? body.placement(time)
                  : bodies::Placement::turned(body.frame_origin, body.frame_axis, body.frame_angle);
    (is_moving ? moving_bodies_ : static_bodies_).push_back({&body, static_cast<int>(b), at});
  }
}

BodyField::Hit BodyField::nearest(Vec3 p) const {
  Hit hit;
  for (const auto* list : {&static_bodies_, &moving_bodies_}) {
    for (const Placed& b : *list) {
      const auto s = b.body->nearest(p, b.at);
      if (s.distance < hit.distance) hit = {s.distance, s.normal, b.number};
    }
  }
  return hit;
}

double BodyField::distance_to_moving_bodies(Vec3 p) const {
  double least = std::numeric_limits<double>::max();
  for (const Placed& b : moving_bodies_) least = std::min(least, b.body->nearest(p, b.at).distance);
  return least;
}

bool BodyField::is_inside(Vec3 p) const { return nearest(p).distance <= k_on_surface * smallest_; }

double BodyField::open_share(Vec3 centre, Vec3 size, Vec3* middle, double smear) const {
  const double reach = 0.5 * norm(size);
  const Hit at_centre = nearest(centre);
  const auto own_way = [&](const Hit& hit, Vec3 p) {
    if (smear == 0.0) return 0.0;
    for (const Placed& b : moving_bodies_) {
      if (b.number == hit.body) return smear * std::abs(dot(b.at.velocity_at(p), hit.normal));
    }
    return 0.0;
  };
  const double far = reach + 0.5 * own_way(at_centre, centre);
  if (at_centre.distance >= far) return 1.0;
  if (at_centre.distance <= -far) return 0.0;
  std::array<int, 3> n{};
  for (int d = 0; d < 3; ++d) n[d] = size[d] > 0.0 ? k_sub_boxes : 1;
  double sum = 0.0;
  Vec3 moment;
  for (int c = 0; c < n[2]; ++c) {
    for (int b = 0; b < n[1]; ++b) {
      for (int a = 0; a < n[0]; ++a) {
        const Vec3 p{centre.x + ((a + 0.5) / n[0] - 0.5) * size.x,
                     centre.y + ((b + 0.5) / n[1] - 0.5) * size.y,
                     centre.z + ((c + 0.5) / n[2] - 0.5) * size.z};
        const Hit hit = nearest(p);
        double width = own_way(hit, p);
        for (int d = 0; d < 3; ++d) width += std::abs(hit.normal[d]) * size[d] / n[d];
        double part = hit.distance > k_on_surface * smallest_ ? 1.0 : 0.0;
        if (width > k_on_surface * smallest_) {
          part = std::clamp(0.5 + hit.distance / width, 0.0, 1.0);
        }
        sum += part;
        moment += part * (p - centre);
      }
    }
  }
  if (middle != nullptr && sum > 0.0) *middle = centre + moment / sum;
  const double share = sum / (n[0] * n[1] * n[2]);
  if (share < k_min_opening) return 0.0;
  return share > 1.0 - k_min_opening ? 1.0 : share;
}

double BodyField::wall_distance(Vec3 from, Vec3 to) const {
  double low = 0.0;
  double high = 1.0;
  for (int step = 0; step < 50; ++step) {
    const double mid = 0.5 * (low + high);
    (nearest(from + mid * (to - from)).distance > 0.0 ? low : high) = mid;
  }
  return high * norm(to - from);
}

std::optional<Vec3> BodyField::outside(Vec3 centre) const {
  const Hit hit = nearest(centre);
  const double beside = k_beside * smallest_;
  if (hit.distance >= beside) return centre;
  const Vec3 p = centre + (beside - hit.distance) * hit.normal;
  if (nearest(p).distance < 0.5 * beside) return std::nullopt;
  return p;
}

bool BodyField::meets(Vec3 from, Vec3 along, double length, double& way, Hit& hit) const {
  way = 0.0;
  for (int step = 0; step < k_max_steps && way < length; ++step) {
    hit = nearest(from + way * along);
    if (hit.distance <= 0.1 * k_beside * smallest_) return true;
    way += k_stride * hit.distance;
  }
  return false;
}

std::optional<double> BodyField::passes_through(Vec3 from, Vec3 to) const {
  const double length = norm(to - from);
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 along = (to - from) / length;
  double way = 0.0;
  double way_back = 0.0;
  Hit in;
  Hit out;
  if (!meets(from, along, length, way, in)) return std::nullopt;
  if (!meets(to, -along, length, way_back, out)) return std::nullopt;
  // Through a thin body the two surfaces look away from each other; a chord's look the same way.
  if (dot(in.normal, out.normal) >= 0.0) return std::nullopt;
  return way;
}

}  // namespace dust::fluid

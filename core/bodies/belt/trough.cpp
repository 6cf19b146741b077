// SPDX-License-Identifier: Apache-2.0
#include "bodies/belt/trough.hpp"

#include "bodies/belt/length_of.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dust::bodies {
namespace {

using sdk::Vec3;

/// Below this slope a section is flat: the bend's radius would be lost in rounding.
constexpr double k_flat = 1e-6;
/// Corrections of the place along the run: three or four for a grain that touches the belt.
constexpr int k_max_corrections = 30;
/// [m] A correction this small ends them: the distance is then right to its square over the grain's
/// radius, to rounding that is.
constexpr double k_place = 1e-9;
/// Sections looked at first for a point far from the belt, where corrections may lead astray.
constexpr int k_sections = 8;

/// Rises from 0 to 1 with level ends, as does its rate at either end: \f$ 3 t^2 - 2 t^3 \f$.
double smooth_step(double t) { return t * t * (3.0 - 2.0 * t); }
double smooth_step_rate(double t) { return 6.0 * t * (1.0 - t); }

}  // namespace

Trough::Trough(const TroughParameters& p) : p_(p) {
  full_ = measured(-0.5 * (p.length + p.head_transition - p.tail_transition));
}

/// [m/rad] How the wing's end moves along the wing as the trough angle grows.
double Trough::wing_end_rate(double slope) const {
  if (slope < k_flat) return 0.0;
  const double square = slope * slope;
  return -p_.bend * (1.0 / slope - std::atan(slope) * (1.0 + square) / square);
}

bool Trough::is_even(double from, double to) const {
  return p_.sag == 0.0 && to <= -p_.head_transition && from >= p_.tail_transition - p_.length;
}

Trough::Section Trough::section(double x) const { return is_even(x, x) ? full_ : measured(x); }

/// Where the edge is so that the belt keeps its width: the bend takes 2 T beta / (2 tan(beta/2)) of
/// it.
double Trough::wing_end(double slope) const {
  const double angle_per_slope = slope < k_flat ? 2.0 : 2.0 * std::atan(slope) / slope;
  return p_.half_width - p_.half_centre + 2.0 * p_.bend - p_.bend * angle_per_slope;
}

Trough::Section Trough::measured(double x) const {
  Section s;
  const auto blend = [&](double way, double length, double sign) {
    const double t = std::clamp(way / length, 0.0, 1.0);
    s.slope *= smooth_step(t);
    s.slope_change = s.slope_change * smooth_step(t);
    if (t < 1.0) s.slope_change += sign * p_.slope * smooth_step_rate(t) / length;
    s.height += p_.rise * (1.0 - smooth_step(t));
    s.height_change -= sign * p_.rise * smooth_step_rate(t) / length;
  };
  s.slope = p_.slope;
  s.height = -p_.rise;
  // A run holds both transitions, so that one of the two is whole at every place.
  if (p_.head_transition > 0.0) blend(-x, p_.head_transition, -1.0);
  if (p_.tail_transition > 0.0) blend(p_.length + x, p_.tail_transition, 1.0);
  if (p_.sag > 0.0) {
    const double turn = 2.0 * std::numbers::pi / p_.idler_spacing;
    s.height -= 0.5 * p_.sag * (1.0 - std::cos(turn * x));
    s.height_change -= 0.5 * p_.sag * turn * std::sin(turn * x);
  }
  if (s.slope < k_flat) s.slope = 0.0;
  const double square = s.slope * s.slope;
  s.sine = 2.0 * s.slope / (1.0 + square);
  s.cosine = (1.0 - square) / (1.0 + square);
  s.radius = s.slope > 0.0 ? p_.bend / s.slope : 0.0;
  return s;
}

Trough::SectionFoot Trough::nearest_in(const Section& s, double y, double z) const {
  const double side = y < 0.0 ? -1.0 : 1.0;
  y *= side;
  z -= s.height;
  const double flat_end = p_.half_centre - p_.bend;
  const double angle_change = 2.0 * s.slope_change / (1.0 + s.slope * s.slope);
  // The flat part first; it moves with the section's height only.
  SectionFoot best{std::min(y, flat_end), 0.0, 0.0};
  double nearest = length_of(y - best.y, z);
  // The wing: the line from where the rolls would meet, at the trough angle. Its end is asked for
  // beyond where it is on a flat belt only.
  const double along = (y - p_.half_centre) * s.cosine + z * s.sine;
  double r = std::max(along, s.radius > 0.0 ? p_.bend : -p_.bend);
  const bool is_beyond = r > p_.half_width - p_.half_centre;
  const double end = is_beyond ? wing_end(s.slope) : r;
  r = std::min(r, end);
  const Vec3 wing{0.0, p_.half_centre + r * s.cosine, r * s.sine};
  if (const double d = length_of(y - wing.y, z - wing.z); d < nearest) {
    nearest = d;
    best = {wing.y, wing.z, 0.0};
    const double edge_rate = is_beyond && r == end ? wing_end_rate(s.slope) : 0.0;
    const double vy = -r * s.sine + edge_rate * s.cosine;
    const double vz = r * s.cosine + edge_rate * s.sine;
    best.pull = angle_change * ((y - wing.y) * vy + (z - wing.z) * vz);
  }
  if (s.radius > 0.0) {
    const double qy = y - flat_end;
    const double qz = z - s.radius;
    const double q = length_of(qy, qz);
    const bool is_in_sector = qy >= 0.0 && -qy * s.cosine - qz * s.sine >= 0.0;
    if (const double d = std::abs(s.radius - q); is_in_sector && q > 0.0 && d < nearest) {
      nearest = d;
      best = {flat_end + s.radius * qy / q, s.radius + s.radius * qz / q, 0.0};
      // Only the bend's motion along its normal counts.
      const double radius_rate = -0.5 * p_.bend * (1.0 + s.slope * s.slope) / (s.slope * s.slope);
      best.pull = angle_change * (s.radius - q) * radius_rate * (-qz / q - 1.0);
    }
  }
  best.pull += (z - best.z) * s.height_change;
  return {side * best.y, best.z + s.height, best.pull};
}

/// Where to begin with a point far from the belt: the nearest of some sections, as corrections from
/// the point's own may lead astray. `nearest` [m] is the distance to that.
double Trough::best_start(Vec3 point, double nearest) const {
  double best = std::clamp(point.x, -p_.length, 0.0);
  const double from = std::max(point.x - nearest, -p_.length);
  const double to = std::min(point.x + nearest, 0.0);
  for (int n = 0; n <= k_sections; ++n) {
    const double x = from + (to - from) * n / k_sections;
    const SectionFoot f = nearest_in(section(x), point.y, point.z);
    const double d = norm(point - Vec3{x, f.y, f.z});
    if (d >= nearest) continue;
    nearest = d;
    best = x;
  }
  return best;
}

Vec3 Trough::foot(Vec3 point) const {
  double x = std::clamp(point.x, -p_.length, 0.0);
  SectionFoot f = nearest_in(section(x), point.y, point.z);
  const double nearest = norm(point - Vec3{x, f.y, f.z});
  // Nothing is nearer than the point's own section where those within reach are the same.
  if (is_even(x - nearest, x + nearest)) return {x, f.y, f.z};
  if (nearest > 2.0 * p_.bend) {
    x = best_start(point, nearest);
    f = nearest_in(section(x), point.y, point.z);
  }
  double last_x = x;
  double last_rest = 0.0;
  for (int n = 0; n < k_max_corrections; ++n) {
    const double rest = point.x + f.pull - x;
    // Along the chord through the last two, where it falls about as steeply as it should.
    const double chord_slope = n > 0 && x != last_x ? (last_rest - rest) / (x - last_x) : 1.0;
    const double change = rest / (chord_slope > 0.4 && chord_slope < 2.5 ? chord_slope : 1.0);
    const double next = std::clamp(x + change, -p_.length, 0.0);
    if (std::abs(next - x) <= k_place) break;
    last_x = x;
    last_rest = rest;
    x = next;
    f = nearest_in(section(x), point.y, point.z);
  }
  return {x, f.y, f.z};
}

Vec3 Trough::at(double x, double across) const {
  const Section s = section(x);
  const double side = across < 0.0 ? -1.0 : 1.0;
  const double w = std::abs(across);
  const double flat_end = p_.half_centre - p_.bend;
  if (w <= flat_end) return {x, across, s.height};
  if (s.radius == 0.0) return {x, across, s.height};
  const double angle = 2.0 * std::atan(s.slope);
  const double theta = (w - flat_end) / s.radius;
  if (theta < angle) {
    return {x, side * (flat_end + s.radius * std::sin(theta)),
            s.height + s.radius * (1.0 - std::cos(theta))};
  }
  const double r = p_.bend + w - flat_end - s.radius * angle;
  return {x, side * (p_.half_centre + r * s.cosine), s.height + r * s.sine};
}

Vec3 Trough::at(double x, double across, double over) const {
  const Section s = section(x);
  const double angle = 2.0 * std::atan(s.slope);
  const double turned = std::abs(across) - (p_.half_centre - p_.bend);
  const double theta = s.radius > 0.0 ? std::clamp(turned / s.radius, 0.0, angle) : 0.0;
  const double sine = std::sin(theta);
  return at(x, across) + over * Vec3{0.0, across < 0.0 ? sine : -sine, std::cos(theta)};
}

Trough::Seen Trough::seen_from(double x, double y, double z) const {
  const Section s = section(x);
  const SectionFoot f = nearest_in(s, y, z);
  const double side = y < 0.0 ? -1.0 : 1.0;
  const double flat_end = p_.half_centre - p_.bend;
  const double foot_y = std::abs(f.y);
  const double foot_z = f.z - s.height;
  const double wing = (foot_y - p_.half_centre) * s.cosine + foot_z * s.sine;
  double theta = 0.0;
  Seen seen;
  seen.past_edge = -std::numeric_limits<double>::infinity();
  if (s.radius > 0.0 && foot_y > flat_end) {
    const double angle = 2.0 * std::atan(s.slope);
    const bool is_on_wing = wing >= p_.bend;
    theta = is_on_wing ? angle : std::atan2(foot_y - flat_end, s.radius - foot_z);
    seen.across = flat_end + s.radius * theta + (is_on_wing ? wing - p_.bend : 0.0);
  } else {
    seen.across = foot_y;
  }
  const double sine = std::sin(theta);
  const double cosine = std::cos(theta);
  const double off_y = side * y - foot_y;
  const double off_z = z - f.z;
  seen.over = -off_y * sine + off_z * cosine;
  if (seen.across > p_.half_centre) {
    seen.past_edge = seen.across - p_.half_width + off_y * cosine + off_z * sine;
  }
  seen.across *= side;
  seen.normal = {0.0, -side * sine, cosine};
  seen.side = {0.0, side * cosine, sine};
  return seen;
}

Vec3 Trough::running_direction(Vec3 foot) const {
  const double x = std::clamp(foot.x, -p_.length, 0.0);
  const Section s = section(x);
  Vec3 way{1.0, 0.0, s.height_change};
  const double y = std::abs(foot.y) - p_.half_centre;
  if (s.slope_change != 0.0 && s.radius > 0.0 && y > -p_.bend) {
    // How a point of the belt goes that keeps its place across it, with the trough angle.
    const double z = foot.z - s.height;
    const double r = y * s.cosine + z * s.sine;
    double vy = 0.0;
    double vz = 0.0;
    if (r > p_.bend) {
      const double edge_rate = wing_end_rate(s.slope);
      vy = -r * s.sine + edge_rate * s.cosine;
      vz = r * s.cosine + edge_rate * s.sine;
    } else {
      const double theta = std::atan2(y + p_.bend, s.radius - z);
      const double sine = std::sin(theta);
      const double cosine = std::cos(theta);
      const double radius_rate = -0.5 * p_.bend * (1.0 / (s.slope * s.slope) + 1.0);
      vy = radius_rate * (sine - theta * cosine);
      vz = radius_rate * (1.0 - cosine - theta * sine);
    }
    const double angle_change = 2.0 * s.slope_change / (1.0 + s.slope * s.slope);
    way.y = (foot.y < 0.0 ? -vy : vy) * angle_change;
    way.z += vz * angle_change;
  }
  return way / norm(way);
}

}  // namespace dust::bodies

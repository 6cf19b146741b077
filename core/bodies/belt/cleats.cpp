// SPDX-License-Identifier: Apache-2.0
#include "bodies/belt/cleats.hpp"

#include "bodies/shape_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::bodies {

using sdk::Vec3;

Cleats::Cleats(const CleatParameters& p) : p_(p) {
  half_round_ = std::numbers::pi * p.reach;
  lap_ = 2.0 * (half_round_ + p.length);
  count_ = std::max(1, static_cast<int>(std::lround(lap_ / p.spacing)));
  spacing_ = lap_ / count_;
}

double Cleats::tip_radius() const { return std::hypot(p_.reach + p_.top, 0.5 * p_.thickness); }

Cleats::Stand Cleats::stand_at(double way) const {
  double s = std::fmod(way, lap_);
  if (s < 0.0) s += lap_;
  if (s < half_round_) {
    const double angle = s / p_.reach;
    const Vec3 out{std::sin(angle), 0.0, std::cos(angle)};
    return {p_.reach * out, {out.z, 0.0, -out.x}, out, true, 0.0};
  }
  s -= half_round_;
  if (s < p_.length) return {{-s, 0.0, -p_.reach}, {-1, 0, 0}, {0, 0, -1}};
  s -= p_.length;
  if (s < half_round_) {
    const double angle = s / p_.reach;
    const Vec3 out{-std::sin(angle), 0.0, -std::cos(angle)};
    return {
        Vec3{-p_.length, 0.0, 0.0} + p_.reach * out, {out.z, 0.0, -out.x}, out, true, -p_.length};
  }
  s -= half_round_;
  return {{s - p_.length, 0.0, p_.reach}, {1, 0, 0}, {0, 0, 1}};
}

SurfacePoint Cleats::box(const Stand& stand, Vec3 q) const {
  const Vec3 off = q - stand.base;
  const double a = dot(off, stand.along);
  const double n = dot(off, stand.out);
  const double half = 0.5 * p_.thickness;
  const double beyond_a = a - std::clamp(a, -half, half);
  const double beyond_y = off.y - std::clamp(off.y, -p_.half_width, p_.half_width);
  const double beyond_n = n - std::clamp(n, 0.0, p_.top);
  const Vec3 away = beyond_a * stand.along + beyond_n * stand.out + Vec3{0.0, beyond_y, 0.0};
  const double distance = norm(away);
  if (distance > 0.0) return {distance, away / distance};
  // Inside; the foot is in the belt.
  SurfacePoint s{n - p_.top, stand.out};
  if (std::abs(a) - half > s.distance) {
    s = {std::abs(a) - half, a < 0.0 ? -stand.along : stand.along};
  }
  const double beside = std::abs(off.y) - p_.half_width;
  if (beside > s.distance) s = {beside, Vec3{0.0, off.y < 0.0 ? -1.0 : 1.0, 0.0}};
  return s;
}

Cleats::Nearest Cleats::nearest(double run, Vec3 q, double limit) const {
  Nearest best;
  best.point.distance = limit;
  // Of equal boxes in a row or round an axis the nearest is the one whose middle is, beside a
  // tangent line one of the two next to the point. `from` to `to` is the way of a run or of
  // a pulley.
  const auto look = [&](double way, double from, double to) {
    const double place = (way - run) / spacing_;
    const bool is_inner = way - from > spacing_ && to - way > spacing_;
    const double first = is_inner ? std::round(place) : std::floor(place);
    for (double k = first; k <= (is_inner ? first : first + 1.0); k += 1.0) {
      const Stand stand = stand_at(k * spacing_ + run);
      const SurfacePoint s = box(stand, q);
      if (s.distance < best.point.distance) best = {s, stand};
    }
  };
  const double x = std::clamp(q.x, -p_.length, 0.0);
  const double back = half_round_ + p_.length;  // where the return run ends
  const double high = std::max(q.z - p_.reach - p_.top, p_.reach - q.z);
  if (high < best.point.distance) look(lap_ + x, back + half_round_, lap_);
  const double low = std::max(-q.z - p_.reach - p_.top, q.z + p_.reach);
  if (low < best.point.distance) look(half_round_ - x, half_round_, back);
  if (q.x > 0.0) look(p_.reach * std::atan2(q.x, q.z), 0.0, half_round_);
  const double behind = -p_.length - q.x;
  if (behind > 0.0) {
    look(back + p_.reach * std::atan2(behind, -q.z), back, back + half_round_);
  }
  return best;
}

Triangles Cleats::triangles(double run, double from, double to) const {
  Triangles t;
  for (int k = 0; k < count_; ++k) {
    const Stand s = stand_at(k * spacing_ + run);
    if (s.base.x < from || s.base.x > to) {
      if (!(s.is_on_pulley && s.pulley >= from && s.pulley <= to)) continue;
    }
    const auto corner = [&](double a, double y, double n) {
      return s.base + 0.5 * a * p_.thickness * s.along + Vec3{0.0, y * p_.half_width, 0.0} +
             n * p_.top * s.out;
    };
    add_quad(t, corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1), corner(-1, 1, 1));
    add_quad(t, corner(1, -1, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, -1, 1));
    add_quad(t, corner(-1, -1, 0), corner(-1, -1, 1), corner(-1, 1, 1), corner(-1, 1, 0));
    add_quad(t, corner(-1, 1, 0), corner(-1, 1, 1), corner(1, 1, 1), corner(1, 1, 0));
    add_quad(t, corner(-1, -1, 0), corner(1, -1, 0), corner(1, -1, 1), corner(-1, -1, 1));
  }
  return t;
}

}  // namespace dust::bodies

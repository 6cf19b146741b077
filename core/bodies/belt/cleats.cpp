// SPDX-License-Identifier: Apache-2.0
#include "bodies/belt/cleats.hpp"

#include "bodies/belt/length_of.hpp"
#include "bodies/shape_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace dust::bodies {

using sdk::Vec3;

Cleats::Cleats(const CleatParameters& p)
    : p_(p), top_(p.face + p.height), section_(p.profile, p.thickness, p.height, p.face) {
  half_round_ = std::numbers::pi * p.reach;
  lap_ = 2.0 * (half_round_ + p.length);
  rows_ = p.profile == BarSection::Profile::round ? 2 : 1;
  count_ = rows_ * std::max(1, static_cast<int>(std::lround(lap_ / (rows_ * p.spacing))));
  gap_ = lap_ / count_;
  if (rows_ == 2 && p.thickness == p.spacing) {
    p_.thickness = gap_;
    section_ = BarSection(p.profile, gap_, p.height, p.face);
  }
  if (!p.trough) return;
  const TroughParameters& t = p.trough->parameters();
  lowest_ = -t.rise - t.sag;
  highest_ = top_ + std::sin(2.0 * std::atan(t.slope)) * (t.half_width - t.half_centre + t.bend);
}

double Cleats::tip_radius() const { return length_of(p_.reach + top_, section_.reach()); }

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
  return {{s - p_.length, 0.0, p_.reach}, {1, 0, 0}, {0, 0, 1}, false, 0.0, p_.trough.has_value()};
}

namespace {

/// Distance [m] to a bar in coordinates of its own: `a` along the belt from its middle, `n` over
/// the middle surface, `beside` from its end, negative inside; with their axes.
struct BarPlace {
  double a = 0.0, n = 0.0, beside = 0.0;
  Vec3 along, out, side;
};
SurfacePoint nearest_of_bar(const BarPlace& p, const BarSection& section) {
  const BarSection::Nearest s = section.nearest(p.a, p.n);
  const Vec3 normal = s.along * p.along + s.over * p.out;
  if (s.distance <= 0.0 && p.beside <= 0.0) {
    return p.beside > s.distance ? SurfacePoint{p.beside, p.side}
                                 : SurfacePoint{s.distance, normal};
  }
  const Vec3 away = std::max(s.distance, 0.0) * normal + std::max(p.beside, 0.0) * p.side;
  const double distance = norm(away);
  return {distance, away / distance};
}

}  // namespace

SurfacePoint Cleats::strip(const Stand& stand, Vec3 q) const {
  const Trough::Seen seen = p_.trough->seen_from(stand.base.x, q.y, q.z - p_.reach);
  return nearest_of_bar(
      {q.x - stand.base.x, seen.over, seen.past_edge, stand.along, seen.normal, seen.side},
      section_);
}

Vec3 Cleats::velocity_in_trough(const Stand& stand, Vec3 q) const {
  const double x = stand.base.x;
  if (p_.trough->is_even(x, x)) return stand.along;
  // Of the point that keeps its place across the belt and over it: docs/theory/conveyors.md, eq.
  // (6).
  const Trough::Seen seen = p_.trough->seen_from(x, q.y, q.z - p_.reach);
  constexpr double k_step = 1e-5;  // [m] error of second order in it
  const double before = std::max(x - k_step, -p_.length);
  const double after = std::min(x + k_step, 0.0);
  return (p_.trough->at(after, seen.across, seen.over) -
          p_.trough->at(before, seen.across, seen.over)) /
         (after - before);
}

double Cleats::largest_factor() const {
  double largest = tip_radius() / p_.reach;
  if (!p_.trough) return largest;
  constexpr int k_places = 400;
  for (int n = 0; n <= k_places; ++n) {
    const double x = -p_.length * n / k_places;
    for (const double over : {0.0, top_}) {
      const Vec3 edge = p_.trough->at(x, p_.half_width, over) + Vec3{0.0, 0.0, p_.reach};
      largest = std::max(largest, norm(velocity_in_trough({.base = {x, 0.0, p_.reach},
                                                           .along = {1, 0, 0},
                                                           .out = {0, 0, 1},
                                                           .is_in_trough = true},
                                                          edge)));
    }
  }
  return largest;
}

/// Cleats of other sections may be nearer than the one whose middle is: all that are not farther
/// along the belt than the nearest so far.
void Cleats::look_in_trough(double run, Vec3 q, Nearest& best) const {
  const double place = (lap_ + std::clamp(q.x, -p_.length, 0.0) - run) / spacing();
  const double off_box =
      length_of(std::max({q.z - p_.reach - highest_, p_.reach + lowest_ - q.z, 0.0}),
                std::max(std::abs(q.y) - p_.half_width, 0.0));
  const auto look = [&](double k) {
    const Stand stand = stand_at(k * spacing() + run);
    const double ahead = std::abs(q.x - stand.base.x) - section_.reach();
    // No nearer than the box round them all.
    if (stand.is_in_trough && ahead > 0.0 &&
        ahead * ahead + off_box * off_box >= best.point.distance * best.point.distance) {
      return false;
    }
    const SurfacePoint s = stand.is_in_trough ? strip(stand, q) : straight(stand, q);
    if (s.distance < best.point.distance) best = {s, stand};
    return stand.is_in_trough;
  };
  // Outwards on either side, to the first on a pulley.
  double k = std::floor(place);
  while (look(k)) k -= 1.0;
  k = std::floor(place) + 1.0;
  while (look(k)) k += 1.0;
}

SurfacePoint Cleats::straight(const Stand& stand, Vec3 q) const {
  const Vec3 off = q - stand.base;
  return nearest_of_bar(
      {dot(off, stand.along), dot(off, stand.out), std::abs(off.y) - p_.half_width, stand.along,
       stand.out, Vec3{0.0, off.y < 0.0 ? -1.0 : 1.0, 0.0}},
      section_);
}

Cleats::Nearest Cleats::nearest(double run, int row, Vec3 q, double limit) const {
  run += row * gap_;
  Nearest best;
  best.point.distance = limit;
  // Of equal bars in a row or round an axis the nearest is the one whose middle is, beside a
  // tangent line one of the two next to the point. `from` to `to` is the way of a run or of
  // a pulley.
  const auto look = [&](double way, double from, double to) {
    const double place = (way - run) / spacing();
    const bool is_inner = way - from > spacing() && to - way > spacing();
    const double first = is_inner ? std::round(place) : std::floor(place);
    for (double k = first; k <= (is_inner ? first : first + 1.0); k += 1.0) {
      const Stand stand = stand_at(k * spacing() + run);
      const SurfacePoint s = straight(stand, q);
      if (s.distance < best.point.distance) best = {s, stand};
    }
  };
  const double x = std::clamp(q.x, -p_.length, 0.0);
  const double back = half_round_ + p_.length;  // where the return run ends
  if (p_.trough) {
    const double over = std::max(q.z - p_.reach - highest_, p_.reach + lowest_ - q.z);
    if (over < best.point.distance) look_in_trough(run, q, best);
  } else {
    const double high = std::max(q.z - p_.reach - top_, p_.reach - q.z);
    if (high < best.point.distance) look(lap_ + x, back + half_round_, lap_);
  }
  const double low = std::max(-q.z - p_.reach - top_, q.z + p_.reach);
  if (low < best.point.distance) look(half_round_ - x, half_round_, back);
  if (q.x > 0.0) look(p_.reach * std::atan2(q.x, q.z), 0.0, half_round_);
  const double behind = -p_.length - q.x;
  if (behind > 0.0) {
    look(back + p_.reach * std::atan2(behind, -q.z), back, back + half_round_);
  }
  return best;
}

namespace {

/// Both ends, in strips from one side of the outline to the other. `corner(point, is_left)`.
template <class Corner>
void add_ends(Triangles& t, const std::vector<BarSection::Point>& outline, const Corner& corner) {
  for (const bool is_left : {true, false}) {
    std::size_t behind = 0;
    std::size_t before = outline.size() - 1;
    for (; behind + 1 < before; ++behind, --before) {
      const Vec3 low[2] = {corner(outline[behind], is_left), corner(outline[before], is_left)};
      const Vec3 high[2] = {corner(outline[behind + 1], is_left),
                            corner(outline[before - 1], is_left)};
      const int first = is_left ? 0 : 1;
      if (behind + 1 == before - 1) {
        t.insert(t.end(), {low[first], high[0], low[1 - first]});
      } else {
        add_quad(t, low[first], high[first], high[1 - first], low[1 - first]);
      }
    }
  }
}

}  // namespace

void Cleats::draw_in_trough(Triangles& t, const Stand& stand,
                            const std::vector<BarSection::Point>& outline,
                            const std::vector<double>& widths) const {
  const auto corner = [&](const BarSection::Point& p, double across) {
    return p_.trough->at(stand.base.x, across, p.n) + Vec3{p.a, 0.0, p_.reach};
  };
  for (std::size_t k = 0; k + 1 < widths.size(); ++k) {
    for (std::size_t n = 0; n + 1 < outline.size(); ++n) {
      add_quad(t, corner(outline[n], widths[k]), corner(outline[n + 1], widths[k]),
               corner(outline[n + 1], widths[k + 1]), corner(outline[n], widths[k + 1]));
    }
  }
  add_ends(t, outline, [&](const BarSection::Point& p, bool is_left) {
    return corner(p, is_left ? widths.back() : widths.front());
  });
}

Triangles Cleats::triangles(double run, double from, double to,
                            const std::vector<double>& widths) const {
  const std::vector<BarSection::Point> outline = section_.outline();
  Triangles t;
  for (int k = 0; k < count_; ++k) {
    const Stand s = stand_at(k * gap_ + run);
    if (s.base.x < from || s.base.x > to) {
      if (!(s.is_on_pulley && s.pulley >= from && s.pulley <= to)) continue;
    }
    if (s.is_in_trough) {
      draw_in_trough(t, s, outline, widths);
      continue;
    }
    const auto corner = [&](const BarSection::Point& p, bool is_left) {
      return s.base + p.a * s.along + Vec3{0.0, is_left ? p_.half_width : -p_.half_width, 0.0} +
             p.n * s.out;
    };
    for (std::size_t n = 0; n + 1 < outline.size(); ++n) {
      add_quad(t, corner(outline[n], false), corner(outline[n + 1], false),
               corner(outline[n + 1], true), corner(outline[n], true));
    }
    add_ends(t, outline, corner);
  }
  return t;
}

}  // namespace dust::bodies

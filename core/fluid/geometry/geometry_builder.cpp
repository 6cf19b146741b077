// SPDX-License-Identifier: Apache-2.0
#include "fluid/geometry/geometry_builder.hpp"
#include "fluid/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace dust::fluid {
namespace {

/// Distance from the surfaces (in cells) beyond which no thin body can come between two neighbours.
constexpr double k_near = 1.8;
/// Distance of a body (in diagonals of a cell or face) beyond which it has no part in what is open
/// of it: half a diagonal to the corner, and half the width of a sub-box and of its way there.
constexpr double k_apart = 0.7;

}  // namespace

GeometryBuilder::GeometryBuilder(const Grid& grid, const bodies::BodySet& bodies,
                                 const SideKinds& sides, const FaceProperties& properties,
                                 TimeInterval interval, const Geometry* static_geometry,
                                 BodyField::Which which)
    : grid_(grid),
      bodies_(bodies),
      sides_(sides),
      properties_(properties),
      static_geometry_(static_geometry),
      field_(grid, bodies, interval.end, which) {
  if (field_.has_moving_bodies()) {
    smear_ = (interval.end - interval.begin) / k_instants;
    for (int n = 0; n < k_instants; ++n) {
      instants_.emplace_back(grid, bodies, interval.begin + (n + 0.5) * smear_, which);
    }
  }
  for (int d = 0; d < 3; ++d) {
    if (grid.count[d] > 1) near_ = std::max(near_, k_near * grid.spacing[d]);
  }
}

Geometry GeometryBuilder::build() {
  measure_cells();
  for (int d = 0; d < 3; ++d) measure_faces(d);
  for (int d = 0; d < 3; ++d) find_blocked(d);
  for (int d = 0; d < 3; ++d) find_unknowns(d);
  for (int d = 0; d < 3; ++d) {
    const auto& kind = g_.kind[d];
    g_.has_unknown[d] = std::find(kind.begin(), kind.end(), FaceKind::plain) != kind.end();
    find_cut(d);
    find_open_parts(d);
    find_ghosts(d);
  }
  SkewStencils({grid_, bodies_, sides_, properties_, field_, distance_, closed_}, g_, points_)
      .find();
  sort_wall_points();
  return std::move(g_);
}

void GeometryBuilder::measure_cells() {
  const auto& n = grid_.count;
  g_.open_fraction.assign(grid_.size, 1.0);
  if (field_.is_empty()) return;
  distance_.assign(grid_.size, 0.0);
  const double reach = k_apart * norm(grid_.spacing);
  for_rows(n[0] * 100, n[1], n[2], [&](int j, int k) {
    for (int i = 0; i < n[0]; ++i) {
      const std::ptrdiff_t o = grid_.index(i, j, k);
      const Vec3 centre = grid_.centre(i, j, k);
      distance_[o] = field_.nearest(centre).distance;
      g_.open_fraction[o] = is_as_static(field_, centre, reach)
                                ? static_geometry_->open_fraction[o]
                                : field_.open_share(centre, grid_.spacing);
    }
  });
}

void GeometryBuilder::measure_faces(int d) {
  const auto& n = grid_.count;
  auto& e = g_.extent[d];
  e = n;
  if (!sides_.is_periodic[d]) e[d] += 1;
  auto& area = g_.open_area.component[d];
  area.assign(grid_.size, 0.0);
  closed_[d].assign(grid_.size, 0);
  Vec3 size = grid_.spacing;
  size[d] = 0.0;
  const double reach = norm(grid_.spacing);
  const double apart = k_apart * norm(size);
  const auto open_share = [&](const BodyField& field, Vec3 centre, std::ptrdiff_t o, double smear) {
    if (is_as_static(field, centre, apart)) return static_geometry_->open_area.component[d][o];
    return field.open_share(centre, size, nullptr, smear);
  };
  for_rows(e[0] * 100, e[1], e[2], [&](int j, int k) {
    for (int i = 0; i < e[0]; ++i) {
      const std::ptrdiff_t o = grid_.index(i, j, k);
      const Vec3 centre = grid_.face(d, i, j, k);
      bool is_still = true;
      for (const BodyField& instant : instants_) {
        is_still = is_still && is_as_static(instant, centre, reach);
      }
      is_still = is_still && (instants_.empty() || is_as_static(field_, centre, reach));
      double now = 1.0;
      if (is_still && static_geometry_ != nullptr) {
        now = area[o] = static_geometry_->open_area.component[d][o];
      } else if (!field_.is_empty()) {
        now = area[o] = open_share(field_, centre, o, 0.0);
        if (!instants_.empty() && smear_ > 0.0) {
          double sum = 0.0;
          for (const BodyField& instant : instants_) {
            sum += open_share(instant, centre, o, smear_);
          }
          area[o] = sum / k_instants;
        }
      } else {
        area[o] = 1.0;
      }
      closed_[d][o] = now == 0.0 ? 1 : 0;
    }
  });
  if (!sides_.is_periodic[d]) return;
  const int b = (d + 1) % 3;
  const int c = (d + 2) % 3;
  for (int p = 0; p < n[b]; ++p) {
    for (int q = 0; q < n[c]; ++q) {
      const std::ptrdiff_t o = grid_.index(0, 0, 0) + p * grid_.stride[b] + q * grid_.stride[c];
      area[o + n[d] * grid_.stride[d]] = area[o];
    }
  }
}

bool GeometryBuilder::is_near(int d, const std::array<int, 3>& c, std::ptrdiff_t o) const {
  if (distance_.empty()) return false;
  const bool has_upper = c[d] < grid_.count[d];
  const std::ptrdiff_t lower =
      c[d] > 0 || sides_.is_periodic[d] ? wrapped(o, d, c[d], -1) : (has_upper ? o : -1);
  const double a = has_upper ? distance_[o] : distance_[lower];
  const double b = lower >= 0 ? distance_[lower] : a;
  return std::min(a, b) < near_;
}

void GeometryBuilder::find_blocked(int d) {
  if (field_.is_empty() || grid_.count[d] == 1) return;
  const auto& n = grid_.count;
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const std::array<int, 3> c = {i, j, k};
        const std::ptrdiff_t o = grid_.index(i, j, k);
        if (c[d] == 0 && !sides_.is_periodic[d]) continue;
        if (!is_near(d, c, o)) continue;
        const Vec3 upper = grid_.centre(i, j, k);
        Vec3 lower = upper;
        lower[d] -= grid_.spacing[d];
        bool is_blocked = add_blocked(d, c, lower, upper);
        if (!is_blocked && c[d] == 0) {
          // What stands before the other side of a periodic pair stands between these two as well.
          Vec3 period;
          period[d] = grid_.period()[d];
          is_blocked = add_blocked(d, c, lower + period, upper + period);
        }
        if (is_blocked) closed_[d][o] = 2;
      }
    }
  }
}

/// Whether a thin body keeps apart the cells round two points.
bool GeometryBuilder::add_blocked(int d, const std::array<int, 3>& c, Vec3 lower, Vec3 upper) {
  const auto from = field_.outside(lower);
  const auto to = field_.outside(upper);
  const auto way = from && to ? field_.passes_through(*from, *to) : std::nullopt;
  if (way) g_.blocked.push_back(blocked_face(d, c, *from, *to, *way));
  return way.has_value();
}

/// `way` [m] from the lower to the upper cell until the body is met.
BlockedFace GeometryBuilder::blocked_face(int d, const std::array<int, 3>& c, Vec3 from, Vec3 to,
                                          double way) const {
  const Vec3 along = (to - from) / norm(to - from);
  const Vec3 first = from + way * along;
  const auto back = field_.passes_through(to, from);
  const Vec3 last = back ? to - *back * along : first;
  Vec3 normal = field_.nearest(first).normal;
  if (dot(normal, to - from) < 0.0) normal = -normal;
  return {.at = static_cast<std::int32_t>(grid_.index(c[0], c[1], c[2])),
          .axis = d,
          .upper = c,
          .middle = 0.5 * (first + last),
          .normal = normal};
}

void GeometryBuilder::find_unknowns(int d) {
  auto& kind = g_.kind[d];
  kind.assign(grid_.size, FaceKind::given);
  const auto& e = g_.extent[d];
  for_rows(e[0] * 100, e[1], e[2], [&](int j, int k) {
    for (int i = 0; i < e[0]; ++i) {
      const std::ptrdiff_t o = grid_.index(i, j, k);
      const std::array<int, 3> c = {i, j, k};
      const bool inside = closed_[d][o] != 0 || is_inside(grid_.face(d, i, j, k));
      bool is_given = false;
      if (!sides_.is_periodic[d]) {
        is_given = (c[d] == 0 && !is_pressure_side(sides_, d, 0)) ||
                   (c[d] == grid_.count[d] && !is_pressure_side(sides_, d, 1));
      }
      kind[o] = inside ? FaceKind::inside : is_given ? FaceKind::given : FaceKind::plain;
    }
  });
}

void GeometryBuilder::find_open_parts(int d) {
  const auto& e = g_.extent[d];
  Vec3 size = grid_.spacing;
  size[d] = 0.0;
  for (int k = 0; k < e[2]; ++k) {
    for (int j = 0; j < e[1]; ++j) {
      for (int i = 0; i < e[0]; ++i) {
        const std::ptrdiff_t o = grid_.index(i, j, k);
        const double area = g_.open_area.component[d][o];
        if (area == 0.0 || area == 1.0 || closed_[d][o] != 0) continue;
        const std::array<int, 3> c = {i, j, k};
        const Vec3 centre = grid_.face(d, i, j, k);
        Vec3 middle = centre;
        static_cast<void>(field_.open_share(centre, size, &middle));
        OpenPart part;
        part.at = static_cast<std::int32_t>(o);
        part.below = static_cast<std::int32_t>(wrapped(o, d, c[d], -1));
        int n = 0;
        for (int dir = 0; dir < 3; ++dir) {
          if (dir == d) continue;
          const double shift = (middle[dir] - centre[dir]) / grid_.spacing[dir];
          part.neighbour[n] = static_cast<std::int32_t>(o);
          if (grid_.count[dir] > 1) {
            part.neighbour[n] =
                static_cast<std::int32_t>(wrapped(o, dir, c[dir], shift > 0.0 ? 1 : -1));
            part.weight[n] = std::abs(shift);
          }
          ++n;
        }
        g_.open_part[d].push_back(part);
      }
    }
  }
}

}  // namespace dust::fluid

// SPDX-License-Identifier: Apache-2.0
#include "fluid/geometry.hpp"

#include "fluid/body_field.hpp"
#include "fluid/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dust::fluid {
namespace {

using sdk::Vec3;

/// Faces deeper inside a body (in cells) take the surface velocity itself.
constexpr double k_ghost_depth = 2.6;

/// Instants at which the shares of faces next to bodies that move are measured, per interval.
constexpr int k_instants = 8;
/// Distance from the surfaces (in cells) beyond which no thin body can come between two neighbours.
constexpr double k_near = 1.8;

using Hit = BodyField::Hit;

struct Point {
  Vec3 place;
  Vec3 normal;
  int body = 0;
};

class Builder {
 public:
  Builder(const Grid& grid, const bodies::BodySet& bodies, const SideKinds& sides,
          const FaceProperties& properties, Geometry::Interval interval, const Geometry* standing,
          BodyField::Which which)
      : grid_(grid),
        bodies_(bodies),
        sides_(sides),
        properties_(properties),
        standing_(standing),
        field_(grid, bodies, interval.end, which) {
    if (field_.has_movers()) {
      smear_ = (interval.end - interval.begin) / k_instants;
      for (int n = 0; n < k_instants; ++n) {
        instants_.emplace_back(grid, bodies, interval.begin + (n + 0.5) * smear_, which);
      }
    }
    for (int d = 0; d < 3; ++d) {
      if (grid.count[d] > 1) near_ = std::max(near_, k_near * grid.spacing[d]);
    }
  }

  Geometry build() {
    measure_cells();
    for (int d = 0; d < 3; ++d) measure_faces(d);
    for (int d = 0; d < 3; ++d) find_parted(d);
    for (int d = 0; d < 3; ++d) find_unknowns(d);
    for (int d = 0; d < 3; ++d) {
      const auto& kind = g_.kind[d];
      g_.has_unknown[d] = std::find(kind.begin(), kind.end(), FaceKind::plain) != kind.end();
      find_cut(d);
      find_open_parts(d);
      find_ghosts(d);
    }
    sort_wall_points();
    return std::move(g_);
  }

  void measure_cells() {
    const auto& n = grid_.count;
    g_.open_fraction.assign(grid_.size, 1.0);
    if (field_.is_empty()) return;
    distance_.assign(grid_.size, 0.0);
    const double reach = norm(grid_.spacing);
    for_rows(n[0] * 100, n[1], n[2], [&](int j, int k) {
      for (int i = 0; i < n[0]; ++i) {
        const std::ptrdiff_t o = grid_.index(i, j, k);
        const Vec3 centre = grid_.centre(i, j, k);
        distance_[o] = field_.nearest(centre).distance;
        g_.open_fraction[o] = is_as_standing(field_, centre, reach)
                                  ? standing_->open_fraction[o]
                                  : field_.open_share(centre, grid_.spacing);
      }
    });
  }
  CellField take_open_fraction() { return std::move(g_.open_fraction); }

 private:
  [[nodiscard]] Hit nearest(Vec3 p) const { return field_.nearest(p); }
  [[nodiscard]] bool is_inside(Vec3 p) const { return field_.is_inside(p); }
  [[nodiscard]] double wall_distance(Vec3 from, Vec3 to) const {
    return field_.wall_distance(from, to);
  }
  /// Are the movers so far that what lies within `reach` of the point is as without them?
  [[nodiscard]] bool is_as_standing(const BodyField& field, Vec3 p, double reach) const {
    return standing_ != nullptr && field.distance_to_movers(p) > reach;
  }

  void measure_faces(int d) {
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
    for_rows(e[0] * 100, e[1], e[2], [&](int j, int k) {
      for (int i = 0; i < e[0]; ++i) {
        const std::ptrdiff_t o = grid_.index(i, j, k);
        const Vec3 centre = grid_.face(d, i, j, k);
        bool is_still = true;
        for (const BodyField& instant : instants_) {
          is_still = is_still && is_as_standing(instant, centre, reach);
        }
        is_still = is_still && (instants_.empty() || is_as_standing(field_, centre, reach));
        double now = 1.0;
        if (is_still && standing_ != nullptr) {
          now = area[o] = standing_->open_area.component[d][o];
        } else if (!field_.is_empty()) {
          now = area[o] = field_.open_share(centre, size);
          if (!instants_.empty() && smear_ > 0.0) {
            double sum = 0.0;
            for (const BodyField& instant : instants_) {
              sum += instant.open_share(centre, size, nullptr, smear_);
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

  /// Is a surface so near to the face's cells that something may lie between them?
  [[nodiscard]] bool is_near(int d, const std::array<int, 3>& c, std::ptrdiff_t o) const {
    if (distance_.empty()) return false;
    const bool has_upper = c[d] < grid_.count[d];
    const std::ptrdiff_t lower =
        c[d] > 0 || sides_.is_periodic[d] ? wrapped(o, d, c[d], -1) : (has_upper ? o : -1);
    const double a = has_upper ? distance_[o] : distance_[lower];
    const double b = lower >= 0 ? distance_[lower] : a;
    return std::min(a, b) < near_;
  }

  /// Cells whose points in the fluid have a thin body between them have nothing to do with each
  /// other. A way through the grid from one side of the body to the other crosses it somewhere, and
  /// there it meets such a face: nothing leaks.
  void find_parted(int d) {
    if (field_.is_empty() || grid_.count[d] == 1) return;
    const auto& n = grid_.count;
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) {
          const std::array<int, 3> c = {i, j, k};
          const std::ptrdiff_t o = grid_.index(i, j, k);
          if (c[d] == 0 && !sides_.is_periodic[d]) continue;
          if (!(g_.open_area.component[d][o] > 0.0) || !is_near(d, c, o)) continue;
          const Vec3 upper = grid_.centre(i, j, k);
          Vec3 lower = upper;
          lower[d] -= grid_.spacing[d];
          const auto from = field_.outside(lower);
          const auto to = field_.outside(upper);
          if (!from || !to || !field_.passes_through(*from, *to)) continue;
          g_.parted[d].push_back(static_cast<std::int32_t>(o));
          closed_[d][o] = 2;
        }
      }
    }
  }

  void find_unknowns(int d) {
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
          is_given = (c[d] == 0 && !sides_.is_pressure_side(d, 0)) ||
                     (c[d] == grid_.count[d] && !sides_.is_pressure_side(d, 1));
        }
        kind[o] = inside ? FaceKind::inside : is_given ? FaceKind::given : FaceKind::plain;
      }
    });
  }

  std::int32_t add_wall_point(Vec3 near) {
    const Hit hit = nearest(near);
    points_.push_back({near - hit.distance * hit.normal, hit.normal, hit.body});
    return static_cast<std::int32_t>(points_.size() - 1);
  }

  void find_cut(int d) {
    const auto& e = g_.extent[d];
    auto& begin = g_.cut_begin[d];
    begin.assign(static_cast<std::size_t>(e[1]) * e[2] + 1, 0);
    for (int k = 0; k < e[2]; ++k) {
      for (int j = 0; j < e[1]; ++j) {
        for (int i = 0; i < e[0]; ++i) {
          const std::ptrdiff_t o = grid_.index(i, j, k);
          if (g_.kind[d][o] != FaceKind::plain) continue;
          const std::array<int, 3> c = {i, j, k};
          bool is_cut = false;
          CutFace face;
          face.at = static_cast<std::int32_t>(o);
          face.i = static_cast<std::int16_t>(i);
          for (int dir = 0; dir < 3; ++dir) {
            is_cut = stencil(d, dir, c, o, face) || is_cut;
          }
          if (!is_cut) continue;
          g_.kind[d][o] = FaceKind::cut;
          g_.cut[d].push_back(face);
        }
        begin[static_cast<std::size_t>(k) * e[1] + j + 1] =
            static_cast<std::int32_t>(g_.cut[d].size());
      }
    }
  }

  /// Fills the two weights of one direction; true if they differ from the plain stencil's.
  bool stencil(int d, int dir, const std::array<int, 3>& c, std::ptrdiff_t o, CutFace& face) {
    const double h = grid_.spacing[dir];
    if (grid_.count[dir] == 1 && dir != d && !has_fixed(d, dir)) return false;
    if (grid_.count[dir] == 1 && sides_.is_periodic[dir]) return false;
    double distance[2] = {h, h};
    bool is_wall[2] = {false, false};
    bool is_free[2] = {false, false};
    double share[2] = {1.0, 1.0};  // of the stress, where the viscosity jumps
    bool is_irregular = false;
    const Vec3 here = grid_.face(d, c[0], c[1], c[2]);
    const bool may_be_parted = is_near(d, c, o);
    for (int side = 0; side < 2; ++side) {
      const int edge = side == 0 ? 0 : g_.extent[d][dir] - 1;
      if (c[dir] == edge && !sides_.is_periodic[dir]) {
        // The weights of y and z are kept per row, those of x in this list.
        if (dir == 0) is_irregular = true;
        if (dir != d && sides_.beyond(d, dir, side) == Beyond::fixed) {
          distance[side] = 0.5 * h;
          face.wall_point[2 * dir + side] = CutFace::k_side;
        } else {
          is_free[side] = true;
        }
        continue;
      }
      const std::ptrdiff_t q = wrapped(o, dir, c[dir], side == 0 ? -1 : 1);
      Vec3 there = here;
      there[dir] += side == 0 ? -h : h;
      const bool is_closed = g_.kind[d][q] == FaceKind::inside;
      const bool is_solid = is_closed && is_inside(there);
      std::optional<double> thin;
      if (!is_solid && may_be_parted) thin = field_.passes_through(here, there);
      if (!is_solid && !thin) {
        if (is_closed) continue;  // its point is still in the open
        // The shear stress between two layers is that of both in a row: harmonic mean.
        const double own = properties_.viscosity_at(d, o);
        const double other = properties_.viscosity_at(d, q);
        if (own != other) {
          share[side] = 2.0 * other / (own + other);
          is_irregular = true;
        }
        continue;
      }
      double s = thin ? *thin : wall_distance(here, there);
      if (s < k_least_distance * h) {
        s = k_least_distance * h;
        ++g_.close_distances;
      }
      distance[side] = s;
      is_wall[side] = true;
      is_irregular = true;
      there = here;
      there[dir] += side == 0 ? -s : s;
      face.wall_point[2 * dir + side] = add_wall_point(there);
    }
    const bool has_wall = is_wall[0] || is_wall[1];
    for (int side = 0; side < 2; ++side) {
      double weight = 0.0;
      if (!is_free[side]) {
        // Three points at unequal distances: exact for parabolas.
        weight = has_wall && !is_free[1 - side]
                     ? 2.0 / (distance[side] * (distance[0] + distance[1]))
                     : 1.0 / (distance[side] * h);
      }
      face.weight[2 * dir + side] = share[side] * weight;
    }
    return is_irregular;
  }

  void find_open_parts(int d) {
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

  [[nodiscard]] bool has_fixed(int d, int dir) const {
    return sides_.beyond(d, dir, 0) == Beyond::fixed || sides_.beyond(d, dir, 1) == Beyond::fixed;
  }

  [[nodiscard]] std::ptrdiff_t wrapped(std::ptrdiff_t o, int dir, int c, int step) const {
    const std::ptrdiff_t s = grid_.stride[dir];
    if (sides_.is_periodic[dir]) {
      if (c + step < 0) return o + (grid_.count[dir] - 1) * s;
      if (c + step >= grid_.count[dir]) return o - (grid_.count[dir] - 1) * s;
    }
    return o + step * s;
  }

  void find_ghosts(int d) {
    if (field_.is_empty()) return;
    const auto& e = g_.extent[d];
    for (int k = 0; k < e[2]; ++k) {
      for (int j = 0; j < e[1]; ++j) {
        for (int i = 0; i < e[0]; ++i) {
          const std::ptrdiff_t o = grid_.index(i, j, k);
          if (g_.kind[d][o] != FaceKind::inside) continue;
          const Vec3 p = grid_.face(d, i, j, k);
          const Hit hit = nearest(p);
          GhostFace ghost;
          ghost.at = static_cast<std::int32_t>(o);
          ghost.wall_point = static_cast<std::int32_t>(points_.size());
          ghost.is_parted = closed_[d][o] == 2;
          ghost.is_crossed = g_.open_area.component[d][o] > 0.0 && !ghost.is_parted;
          points_.push_back({p - hit.distance * hit.normal, hit.normal, hit.body});
          const double depth = std::max(0.0, -hit.distance);
          const double scale = spacing_along(hit.normal);
          if (depth < k_ghost_depth * scale) find_image(d, p, hit, depth, scale, ghost);
          g_.ghost[d].push_back(ghost);
        }
      }
    }
    const auto deep = std::stable_partition(
        g_.ghost[d].begin(), g_.ghost[d].end(),
        [](const GhostFace& g) { return g.factor > 0.0 || g.is_crossed || g.is_parted; });
    g_.deep_ghosts_begin[d] = static_cast<std::size_t>(deep - g_.ghost[d].begin());
  }

  /// Size of a cell along a direction.
  [[nodiscard]] double spacing_along(Vec3 n) const {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) sum += std::pow(n[d] * grid_.spacing[d], 2);
    return std::sqrt(sum);
  }

  /// The image lies on the normal through the ghost, as far outside that it needs fluid faces only.
  void find_image(int d, Vec3 p, const Hit& hit, double depth, double scale,
                  GhostFace& ghost) const {
    for (int step = 0; step < 5; ++step) {
      const double reach = std::max(depth, scale) + 0.25 * step * scale;
      const Vec3 image = p + (reach - hit.distance) * hit.normal;
      if (is_inside(image)) continue;
      if (!interpolation(d, image, ghost)) continue;
      ghost.factor = depth / reach;
      return;
    }
  }

  /// Trilinear weights of component `d` at `p`; false if a face inside a body carries weight.
  bool interpolation(int d, Vec3 p, GhostFace& ghost) const {
    std::array<int, 3> base{};
    std::array<double, 3> share{};
    for (int dir = 0; dir < 3; ++dir) {
      if (grid_.count[dir] == 1 && dir != d) continue;
      const double x = (p[dir] - grid_.origin[dir]) / grid_.spacing[dir] - (dir == d ? 0.0 : 0.5);
      const int last = g_.extent[d][dir] - 1;
      const double clamped = std::clamp(x, 0.0, static_cast<double>(last));
      base[dir] = std::min(static_cast<int>(clamped), std::max(0, last - 1));
      share[dir] = last > 0 ? clamped - base[dir] : 0.0;
    }
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      std::array<int, 3> c = base;
      for (int dir = 0; dir < 3; ++dir) {
        const int high = corner >> dir & 1;
        weight *= high ? share[dir] : 1.0 - share[dir];
        c[dir] += high;
      }
      const std::ptrdiff_t o =
          weight > 0.0 ? grid_.index(c[0], c[1], c[2]) : grid_.index(base[0], base[1], base[2]);
      if (weight > 1e-12 && g_.kind[d][o] == FaceKind::inside) return false;
      ghost.node[corner] = static_cast<std::int32_t>(o);
      ghost.weight[corner] = weight;
    }
    return true;
  }

  void sort_wall_points() {
    std::vector<std::int32_t> new_place(points_.size());
    WallPoints& w = g_.wall;
    w.body_begin.assign(1, 0);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      for (std::size_t n = 0; n < points_.size(); ++n) {
        const Point& p = points_[n];
        if (p.body != static_cast<int>(b)) continue;
        new_place[n] = static_cast<std::int32_t>(w.x.size());
        w.x.push_back(p.place.x);
        w.y.push_back(p.place.y);
        w.z.push_back(p.place.z);
        w.normal_x.push_back(p.normal.x);
        w.normal_y.push_back(p.normal.y);
        w.normal_z.push_back(p.normal.z);
      }
      w.body_begin.push_back(w.x.size());
    }
    for (auto& v : w.velocity) v.assign(w.x.size(), 0.0);
    for (int d = 0; d < 3; ++d) {
      for (auto& ghost : g_.ghost[d]) ghost.wall_point = new_place[ghost.wall_point];
      for (auto& face : g_.cut[d]) {
        for (auto& point : face.wall_point) {
          if (point >= 0) point = new_place[point];
        }
      }
    }
  }

  const Grid& grid_;
  const bodies::BodySet& bodies_;
  const SideKinds& sides_;
  const FaceProperties& properties_;
  const Geometry* standing_;
  BodyField field_;                                  ///< at the end of the interval
  std::vector<BodyField> instants_;                  ///< if bodies move
  double smear_ = 0.0;                               ///< [s]
  double near_ = 0.0;                                ///< [m]
  CellField distance_;                               ///< [m] of cell centres; empty without bodies
  std::array<std::vector<std::uint8_t>, 3> closed_;  ///< 1 in a body at the end, 2 parted
  Geometry g_;
  std::vector<Point> points_;
};

}  // namespace

void WallPoints::evaluate(const bodies::BodySet& bodies, double time) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::size_t first = body_begin[b];
    const std::size_t count = body_begin[b + 1] - first;
    if (count == 0 || bodies[b].motions.empty()) continue;
    bodies[b].surface_velocities({.count = count,
                                  .time = time,
                                  .axis = {},
                                  .x = &x[first],
                                  .y = &y[first],
                                  .z = &z[first],
                                  .normal_x = &normal_x[first],
                                  .normal_y = &normal_y[first],
                                  .normal_z = &normal_z[first],
                                  .velocity_x = &velocity[0][first],
                                  .velocity_y = &velocity[1][first],
                                  .velocity_z = &velocity[2][first]});
  }
}

Geometry Geometry::build(const Grid& grid, const bodies::BodySet& bodies, const SideKinds& sides,
                         const FaceProperties& properties, Interval interval,
                         const Geometry* standing) {
  return Builder(grid, bodies, sides, properties, interval, standing, BodyField::Which::all)
      .build();
}

Geometry Geometry::build_standing(const Grid& grid, const bodies::BodySet& bodies,
                                  const SideKinds& sides, const FaceProperties& properties) {
  return Builder(grid, bodies, sides, properties, {}, nullptr, BodyField::Which::standing).build();
}

CellField Geometry::open_fractions(const Grid& grid, const bodies::BodySet& bodies,
                                   const SideKinds& sides, const FaceProperties& properties,
                                   double time, const Geometry& standing) {
  Builder builder(grid, bodies, sides, properties, {time, time}, &standing, BodyField::Which::all);
  builder.measure_cells();
  return builder.take_open_fraction();
}

}  // namespace dust::fluid

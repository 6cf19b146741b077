// SPDX-License-Identifier: Apache-2.0
#include "fluid/geometry/geometry_builder.hpp"
#include "fluid/geometry/wrapped.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dust::fluid {
namespace {

/// Faces deeper inside a body (in cells) take the surface velocity itself.
constexpr double k_ghost_depth = 2.6;

}  // namespace

void GeometryBuilder::find_cut(int d) {
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

/// The weights of one direction from what lies on either side of the face, which is `h` from its
/// neighbours.
void GeometryBuilder::set_weights(const std::array<StencilSide, 2>& sides, double h, int dir,
                                  CutFace& face) {
  const bool has_wall = sides[0].is_wall || sides[1].is_wall;
  for (int side = 0; side < 2; ++side) {
    const StencilSide& own = sides[static_cast<std::size_t>(side)];
    const StencilSide& other = sides[static_cast<std::size_t>(1 - side)];
    double weight = 0.0;
    if (!own.is_free) {
      // Three points at unequal distances: exact for parabolas.
      weight = has_wall && !other.is_free
                   ? 2.0 / (own.distance * (sides[0].distance + sides[1].distance))
                   : 1.0 / (own.distance * h);
    }
    face.weight[2 * dir + side] = own.share * weight;
  }
}

/// A side of the domain beside the face; true if its stencil is not the plain one.
bool GeometryBuilder::meet_boundary(int d, int dir, int side, double h, CutFace& face,
                                    StencilSide& here) const {
  if (dir != d && ghost_rule(sides_, d, dir, side) == GhostRule::fixed) {
    here.distance = 0.5 * h;
    face.wall_point[2 * dir + side] = CutFace::k_side;
  } else {
    here.is_free = true;
  }
  // The weights of y and z are kept per row, those of x in this list.
  return dir == 0;
}

/// What lies between a face and its neighbour on one side of it.
GeometryBuilder::Neighbour GeometryBuilder::look(Vec3 from, int dir, int side, LookAt at) const {
  const double h = grid_.spacing[dir];
  const auto look_from = [&](Vec3 here, bool asks_thin) {
    Neighbour neighbour{here, here, false, std::nullopt};
    neighbour.there[dir] += side == 0 ? -h : h;
    neighbour.is_solid = at.is_closed && is_inside(neighbour.there);
    if (!neighbour.is_solid && asks_thin)
      neighbour.thin = field_.passes_through(here, neighbour.there);
    return neighbour;
  };
  const Neighbour here = look_from(from, at.may_be_blocked);
  if (here.is_wall() || !at.is_at_end || field_.is_empty()) return here;
  // Bodies stand where they are, also before the other side of a periodic pair.
  from[dir] += side == 0 ? grid_.period()[dir] : -grid_.period()[dir];
  const Neighbour other = look_from(from, true);
  return other.is_wall() ? other : here;
}

bool GeometryBuilder::stencil(int d, int dir, const std::array<int, 3>& c, std::ptrdiff_t o,
                              CutFace& face) {
  const double h = grid_.spacing[dir];
  if (grid_.count[dir] == 1 && dir != d && !has_fixed(d, dir)) return false;
  if (grid_.count[dir] == 1 && sides_.is_periodic[dir]) return false;
  std::array<StencilSide, 2> sides{StencilSide{h}, StencilSide{h}};
  bool is_irregular = false;
  const Vec3 here = grid_.face(d, c[0], c[1], c[2]);
  const bool may_be_blocked = is_near(d, c, o);
  for (int side = 0; side < 2; ++side) {
    StencilSide& own_side = sides[static_cast<std::size_t>(side)];
    const int edge = side == 0 ? 0 : g_.extent[d][dir] - 1;
    if (c[dir] == edge && !sides_.is_periodic[dir]) {
      if (meet_boundary(d, dir, side, h, face, own_side)) is_irregular = true;
      continue;
    }
    const std::ptrdiff_t q = wrapped(o, dir, c[dir], side == 0 ? -1 : 1);
    const bool is_closed = g_.kind[d][q] == FaceKind::inside;
    const Neighbour neighbour = look(here, dir, side, {is_closed, may_be_blocked, c[dir] == edge});
    if (!neighbour.is_wall()) {
      if (is_closed) continue;  // its point is still in the open
      // The shear stress between two layers is that of both in a row: harmonic mean.
      const double own = properties_.viscosity_at(d, o);
      const double other = properties_.viscosity_at(d, q);
      if (own != other) {
        own_side.share = 2.0 * other / (own + other);
        is_irregular = true;
      }
      continue;
    }
    double s = neighbour.thin ? *neighbour.thin : wall_distance(neighbour.from, neighbour.there);
    if (s < k_min_distance * h) {
      s = k_min_distance * h;
      ++g_.close_distances;
    }
    own_side.distance = s;
    own_side.is_wall = true;
    is_irregular = true;
    Vec3 there = neighbour.from;
    there[dir] += side == 0 ? -s : s;
    face.wall_point[2 * dir + side] = add_wall_point(there);
  }
  set_weights(sides, h, dir, face);
  return is_irregular;
}

std::ptrdiff_t GeometryBuilder::wrapped(std::ptrdiff_t o, int dir, int c, int step) const {
  const std::ptrdiff_t s = grid_.stride[dir];
  if (sides_.is_periodic[dir]) {
    if (c + step < 0) return o + (grid_.count[dir] - 1) * s;
    if (c + step >= grid_.count[dir]) return o - (grid_.count[dir] - 1) * s;
  }
  return o + step * s;
}

void GeometryBuilder::find_ghosts(int d) {
  if (field_.is_empty()) return;
  const auto& e = g_.extent[d];
  for (int k = 0; k < e[2]; ++k) {
    for (int j = 0; j < e[1]; ++j) {
      for (int i = 0; i < e[0]; ++i) {
        const std::ptrdiff_t o = grid_.index(i, j, k);
        if (g_.kind[d][o] != FaceKind::inside) continue;
        Vec3 p = grid_.face(d, i, j, k);
        Hit hit = nearest(p);
        const std::array<int, 3> c = {i, j, k};
        if (closed_[d][o] == 2 && c[d] == 0) {
          // A thin body before the other side of a periodic pair.
          Vec3 other = p;
          other[d] += grid_.period()[d];
          const Hit there = nearest(other);
          if (std::abs(there.distance) < std::abs(hit.distance)) {
            p = other;
            hit = there;
          }
        }
        GhostFace ghost;
        ghost.at = static_cast<std::int32_t>(o);
        ghost.wall_point = static_cast<std::int32_t>(points_.size());
        ghost.is_blocked = closed_[d][o] == 2;
        ghost.is_partly_open = g_.open_area.component[d][o] > 0.0 && !ghost.is_blocked;
        points_.push_back({p - hit.distance * hit.normal, hit.normal, hit.body});
        const double depth = std::max(0.0, -hit.distance);
        const double scale = spacing_along(grid_, hit.normal);
        if (depth < k_ghost_depth * scale) find_image(d, p, hit, depth, scale, ghost);
        g_.ghost[d].push_back(ghost);
      }
    }
  }
  const auto deep = std::stable_partition(
      g_.ghost[d].begin(), g_.ghost[d].end(),
      [](const GhostFace& g) { return g.factor > 0.0 || g.is_partly_open || g.is_blocked; });
  g_.deep_ghosts_begin[d] = static_cast<std::size_t>(deep - g_.ghost[d].begin());
}

void GeometryBuilder::find_image(int d, Vec3 p, const Hit& hit, double depth, double scale,
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

bool GeometryBuilder::interpolation(int d, Vec3 p, GhostFace& ghost) const {
  std::array<int, 3> base{};
  std::array<double, 3> share{};
  for (int dir = 0; dir < 3; ++dir) {
    if (grid_.count[dir] == 1 && dir != d) continue;
    const double x = (p[dir] - grid_.origin[dir]) / grid_.spacing[dir] - (dir == d ? 0.0 : 0.5);
    if (sides_.is_periodic[dir] && grid_.count[dir] > 1) {
      base[dir] = static_cast<int>(std::floor(x));
      share[dir] = x - base[dir];
      continue;
    }
    const int last = g_.extent[d][dir] - 1;
    const double clamped = std::clamp(x, 0.0, static_cast<double>(last));
    base[dir] = std::min(static_cast<int>(clamped), std::max(0, last - 1));
    share[dir] = last > 0 ? clamped - base[dir] : 0.0;
  }
  // Beyond a periodic side the nodes are those at the other end.
  const auto index_of = [this](std::array<int, 3> c) {
    for (int dir = 0; dir < 3; ++dir) {
      if (sides_.is_periodic[dir]) c[dir] = fluid::wrapped(c[dir], grid_.count[dir]);
    }
    return grid_.index(c[0], c[1], c[2]);
  };
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<int, 3> c = base;
    for (int dir = 0; dir < 3; ++dir) {
      const int high = corner >> dir & 1;
      weight *= high ? share[dir] : 1.0 - share[dir];
      c[dir] += high;
    }
    const std::ptrdiff_t o = index_of(weight > 0.0 ? c : base);
    if (weight > 1e-12 && g_.kind[d][o] == FaceKind::inside) return false;
    ghost.node[corner] = static_cast<std::int32_t>(o);
    ghost.weight[corner] = weight;
  }
  return true;
}

void GeometryBuilder::sort_wall_points() {
  std::vector<std::int32_t> new_place(points_.size());
  WallPoints& w = g_.wall;
  w.body_begin.assign(1, 0);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    for (std::size_t n = 0; n < points_.size(); ++n) {
      const SurfacePoint& p = points_[n];
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
    for (auto& face : g_.skew[d]) face.wall_point = new_place[face.wall_point];
    for (auto& node : g_.skew_node[d]) {
      if (node.from < 0) node.from = -1 - new_place[-1 - node.from];
    }
  }
}

}  // namespace dust::fluid

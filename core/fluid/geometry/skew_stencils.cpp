// SPDX-License-Identifier: Apache-2.0
#include "fluid/geometry/skew_stencils.hpp"

#include "fluid/geometry/wrapped.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>

namespace dust::fluid {
namespace {

/// Cells from a surface within which convection runs along it: what its layer needs to come to
/// some cells of thickness. Two let twice the error in, four bring nothing more.
constexpr double k_skew_reach = 3.0;
/// Neighbours looked at, each way, in cells: between 3.5 and 4, so that both components, which
/// stand half a cell off each other, reach as far to one side as to the other.
constexpr double k_patch = 3.75;
constexpr int k_patch_rows = 4;
/// Widths [cells] of the neighbours' weights exp(-(x/width)^2) along the surface and across it:
/// long along it, where little changes, and narrow across it, where the layer is.
constexpr double k_width_along = 2.0;
constexpr double k_width_across = 0.8;
/// Neighbours of less weight than exp(-this) = 0.02 are left out.
constexpr double k_largest_exponent = 3.9;
/// Faces nearer to the surface (in cells, to both sides) put a point of it into the fit.
constexpr double k_at_surface = 0.71;
/// Least product of the normals of two neighbours: the surface bends by 37 degrees at most.
constexpr double k_min_alignment = 0.8;
/// Component of a normal below which it lies in a plane of the grid, or along the grid.
constexpr double k_along_grid = 1e-3;
/// Neighbours needed for the six coefficients of a fit.
constexpr std::size_t k_min_nodes = 10;
/// Largest speed x cell / kinematic viscosity: a layer of less than a tenth of a cell (after the
/// way of a cell) is nothing to be resolved, and the dissipation of the plain scheme is what such
/// flows need. Runs were stable up to three times this.
constexpr double k_largest_cell_reynolds = 1000.0;
/// Pivots of a fit over its largest one below which its points determine less than six
/// coefficients: they lie on a line or two.
constexpr double k_smallest_pivot = 1e-7;
/// Sum of the weights' magnitudes beyond which a fit is taken as undetermined; 2 to 5 is usual.
constexpr double k_largest_weights = 20.0;

/// Of second degree: c0 + c1 x + c2 z + c3 x^2 + c4 x z + c5 z^2.
using Row = Eigen::Vector<double, 6>;
using Square = Eigen::Matrix<double, 6, 6>;

bool is_singular(const Eigen::LDLT<Square>& fit) {
  const auto pivots = fit.vectorD();
  return !(pivots.minCoeff() > k_smallest_pivot * pivots.maxCoeff());
}

}  // namespace

SkewStencils::SkewStencils(const SolverParts& parts, Geometry& geometry,
                           std::vector<SurfacePoint>& points)
    : around_(parts), grid_(parts.grid), sides_(parts.sides), g_(geometry), points_(points) {}

bool SkewStencils::is_turning(int body) const {
  const bodies::Body& b = around_.bodies[static_cast<std::size_t>(body)];
  if (b.motions.empty() || b.is_removed() || b.displaces() || b.suction) return false;
  return b.largest_speed() * grid_.largest_spacing() <=
         k_largest_cell_reynolds * around_.properties.viscosity() / around_.properties.density();
}

void SkewStencils::find() {
  for (int d = 0; d < 3; ++d) {
    g_.skew_begin[d].assign(static_cast<std::size_t>(g_.extent[d][1]) * g_.extent[d][2] + 1, 0);
  }
  bool any = false;
  for (std::size_t b = 0; b < around_.bodies.size(); ++b)
    any = any || is_turning(static_cast<int>(b));
  if (!any || around_.field.is_empty()) return;
  for (int d = 0; d < 3; ++d) find_beside(d);
  for (int d = 0; d < 3; ++d) find_skew(d);
}

std::int32_t SkewStencils::add_foot(Vec3 place, const Hit& hit) {
  points_.push_back({place - hit.distance * hit.normal, hit.normal, hit.body});
  return static_cast<std::int32_t>(points_.size() - 1);
}

void SkewStencils::find_beside(int d) {
  const auto& e = g_.extent[d];
  beside_index_[d].assign(grid_.size, -1);
  const double cell = grid_.largest_spacing();
  const double most = (k_skew_reach + k_patch) * cell;
  for (int k = 0; k < e[2]; ++k) {
    for (int j = 0; j < e[1]; ++j) {
      for (int i = 0; i < e[0]; ++i) {
        const std::array<int, 3> c = {i, j, k};
        const std::ptrdiff_t o = grid_.index(i, j, k);
        const std::ptrdiff_t of_cell = c[d] < grid_.count[d] ? o : o - grid_.stride[d];
        if (std::abs(around_.distance[of_cell]) > most + cell) continue;
        const Hit hit = around_.field.nearest(grid_.face(d, i, j, k));
        const double scale = spacing_along(grid_, hit.normal);
        if (hit.distance < -k_at_surface * scale || hit.distance > most) continue;
        Beside b{hit, -1, is_turning(hit.body)};
        if (b.is_usable && std::abs(hit.distance) < k_at_surface * scale) {
          b.wall_point = add_foot(grid_.face(d, i, j, k), hit);
        }
        beside_index_[d][o] = static_cast<std::int32_t>(beside_[d].size());
        beside_[d].push_back(b);
      }
    }
  }
}

void SkewStencils::find_skew(int d) {
  const auto& e = g_.extent[d];
  for (int k = 0; k < e[2]; ++k) {
    for (int j = 0; j < e[1]; ++j) {
      for (int i = 0; i < e[0]; ++i) add_skew(d, {i, j, k});
      g_.skew_begin[d][static_cast<std::size_t>(k) * e[1] + j + 1] =
          static_cast<std::int32_t>(g_.skew[d].size());
    }
  }
}

void SkewStencils::add_skew(int d, const std::array<int, 3>& c) {
  const std::ptrdiff_t o = grid_.index(c[0], c[1], c[2]);
  if (beside_index_[d][o] < 0 || !is_unknown(g_.kind[d][o])) return;
  if (!sides_.is_periodic[d] && (c[d] == 0 || c[d] == grid_.count[d])) return;
  const Beside& beside = beside_[d][static_cast<std::size_t>(beside_index_[d][o])];
  const Hit& hit = beside.hit;
  if (hit.distance > k_skew_reach * spacing_along(grid_, hit.normal)) return;
  int along = -1;
  for (int dir = 0; dir < 3; ++dir) {
    if (dir != d && std::abs(hit.normal[dir]) < k_along_grid) along = dir;
  }
  if (along < 0) return;
  const int other = 3 - d - along;
  if (grid_.count[d] == 1 || grid_.count[other] == 1) return;
  Vec3 tangent;
  tangent[d] = hit.normal[other];
  tangent[other] = -hit.normal[d];
  SkewFace face;
  face.at = static_cast<std::int32_t>(o);
  face.i = c[0];
  face.along = along;
  face.other = other;
  face.own_part = tangent[d];
  face.other_part = tangent[other];
  face.distance = hit.distance;
  face.inverse_length = 1.0 / spacing_along(grid_, tangent);
  const Frame frame{grid_.face(d, c[0], c[1], c[2]), hit, tangent, along};
  auto& nodes = g_.skew_node[d];
  const auto begin = static_cast<std::int32_t>(nodes.size());
  bool is_askew = false;
  if (fit(d, c, frame, o, nodes, is_askew)) {
    face.begin = begin;
    face.other_begin = static_cast<std::int32_t>(nodes.size());
    if (fit(other, c, frame, -1, nodes, is_askew)) {
      face.end = static_cast<std::int32_t>(nodes.size());
      face.wall_point = beside.wall_point >= 0 ? beside.wall_point : add_foot(frame.place, hit);
      g_.skew[d].push_back(face);
      return;
    }
  }
  nodes.resize(static_cast<std::size_t>(begin));
}

bool SkewStencils::gather(int d, const std::array<int, 3>& c, const Frame& f, bool& is_askew) {
  patch_.clear();
  const int a = (f.along + 1) % 3;
  const int b = (f.along + 2) % 3;
  const double scale_along = spacing_along(grid_, f.tangent);
  const double scale_across = spacing_along(grid_, f.hit.normal);
  for (int q = -k_patch_rows; q <= k_patch_rows; ++q) {
    for (int p = -k_patch_rows; p <= k_patch_rows; ++p) {
      std::array<int, 3> at = c;
      at[a] += p;
      at[b] += q;
      Vec3 way = grid_.face(d, at[0], at[1], at[2]) - f.place;
      way[f.along] = 0.0;
      if (std::abs(way[a]) > k_patch * grid_.spacing[a]) continue;
      if (std::abs(way[b]) > k_patch * grid_.spacing[b]) continue;
      bool is_outside = false;
      for (const int dir : {a, b}) {
        if (sides_.is_periodic[dir]) at[dir] = wrapped(at[dir], grid_.count[dir]);
        is_outside = is_outside || at[dir] < 0 || at[dir] >= g_.extent[d][dir];
      }
      if (is_outside || at[f.along] >= g_.extent[d][f.along]) continue;
      const std::ptrdiff_t o = grid_.index(at[0], at[1], at[2]);
      if (beside_index_[d][o] < 0) continue;
      const Beside& beside = beside_[d][static_cast<std::size_t>(beside_index_[d][o])];
      const auto add = [&](std::int32_t from, Vec3 to, double distance) {
        const double x = dot(to, f.tangent) / scale_along;
        const double z = (distance - f.hit.distance) / scale_across;
        const double exponent =
            x * x / (k_width_along * k_width_along) + z * z / (k_width_across * k_width_across);
        if (exponent > k_largest_exponent) return false;
        patch_.push_back({from, x, z, std::exp(-exponent)});
        return true;
      };
      if (around_.closed[d][o] == 2) return false;
      const bool is_solid = g_.kind[d][o] == FaceKind::inside;
      bool counts = !is_solid && add(static_cast<std::int32_t>(o), way, beside.hit.distance);
      if (beside.wall_point >= 0) {
        const Vec3 foot = way - beside.hit.distance * beside.hit.normal;
        counts = add(-1 - beside.wall_point, foot, 0.0) || counts;
      }
      if (!counts) continue;
      // Only along one smooth surface.
      const Vec3 n = beside.hit.normal;
      if (!beside.is_usable || beside.hit.body != f.hit.body ||
          dot(n, f.hit.normal) < k_min_alignment || std::abs(n[f.along]) > k_along_grid) {
        return false;
      }
      is_askew = is_askew || std::min(std::abs(n[a]), std::abs(n[b])) > k_along_grid;
    }
  }
  return patch_.size() >= k_min_nodes;
}

bool SkewStencils::fit(int d, const std::array<int, 3>& c, const Frame& frame, std::ptrdiff_t self,
                       std::vector<SkewNode>& nodes, bool& is_askew) {
  if (!gather(d, c, frame, is_askew) || !is_askew) return false;
  // By least squares, once with the face itself, once without. Without x^2 the dissipation would be
  // of first order where the surface bends.
  const auto row = [](const PatchPoint& p) {
    return Row{1.0, p.x, p.z, p.x * p.x, p.x * p.z, p.z * p.z};
  };
  Square all = Square::Zero();
  Square others = Square::Zero();
  for (const PatchPoint& p : patch_) {
    const Row r = p.weight * row(p);
    const Square square = r * r.transpose();
    all += square;
    if (p.from != self) others += square;
  }
  const Eigen::LDLT<Square> of_all(all);
  const Eigen::LDLT<Square> of_others(others);
  if (is_singular(of_all) || is_singular(of_others)) return false;
  const Row value = of_others.solve(Row::Unit(0));
  const Row slope = of_all.solve(Row::Unit(1));
  const Row ascent = of_all.solve(Row::Unit(2));
  const double scale_along = spacing_along(grid_, frame.tangent);
  const double scale_across = spacing_along(grid_, frame.hit.normal);
  double size = 0.0;
  for (const PatchPoint& p : patch_) {
    const Row r = (p.weight * p.weight) * row(p);
    SkewNode node;
    node.from = p.from;
    node.mean = p.from == self ? 0.0 : value.dot(r);
    node.slope = slope.dot(r) / scale_along;
    node.ascent = ascent.dot(r) / scale_across;
    size += std::abs(node.mean) + std::abs(slope.dot(r));
    nodes.push_back(node);
  }
  // Too few different distances: the fit says nothing.
  return std::isfinite(size) && size < k_largest_weights;
}

}  // namespace dust::fluid

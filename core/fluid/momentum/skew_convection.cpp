// SPDX-License-Identifier: Apache-2.0
#include "fluid/momentum/skew_convection.hpp"

#include <algorithm>
#include <cmath>

namespace dust::fluid {
namespace {

/// Share of the difference to the neighbours' parabola that a way of one cell takes away. Half of
/// it lets flows grow rough at cell Reynolds numbers of 1000, twice of it thickens the layer.
constexpr double k_dissipation = 0.6;

/// d(u_e)/d(x_e) at a face of component d, mean of the two cells beside it.
double stretch_along(const Grid& grid, const SkewFace& face, const FaceField& u, int d) {
  const int e = face.along;
  if (grid.count[e] == 1) return 0.0;
  const std::ptrdiff_t s = grid.stride[e];
  const double* v = &u.component[e][face.at];
  const std::ptrdiff_t below = -grid.stride[d];
  return 0.5 * ((v[s] - v[0]) + (v[below + s] - v[below])) / grid.spacing[e];
}

/// The layer that a surface drags along has a speed along it between 0 and the surface's: within 1
/// of the middle of that range, in halves of it. As far as `k_layer` convection runs along the
/// surface, from `k_no_layer` on along the grid's lines, between them as a mean of the two. A wind
/// past the surface, or back along it where it comes off, is no such layer: its velocity across the
/// surface is not that of eq. (12), and with it speeds grow without bound.
constexpr double k_layer = 1.1;
constexpr double k_no_layer = 1.5;

/// How much of the flow at a face, of speed `along` the surface, belongs to that layer.
double share_of_layer(const Geometry& geometry, const SkewFace& face, double along, int d) {
  const auto& wall = geometry.wall.velocity;
  const double surface = face.own_part * wall[d][face.wall_point] +
                         face.other_part * wall[face.other][face.wall_point];
  if (surface == 0.0) return 0.0;
  const double from_middle = std::abs(2.0 * along / surface - 1.0);
  return std::clamp((k_no_layer - from_middle) / (k_no_layer - k_layer), 0.0, 1.0);
}

}  // namespace

double convection_along_surface(const Grid& grid, const Geometry& geometry, const SkewFace& face,
                                const FaceField& u, int d, double along_grid) {
  const SkewNode* node = geometry.skew_node[d].data();
  const double* own = u.component[d].data();
  const double* own_wall = geometry.wall.velocity[d].data();
  const double here = own[face.at];
  double mean = 0.0;
  double slope = 0.0;
  double ascent = 0.0;
  double least = here;
  double most = here;
  for (std::int32_t n = face.begin; n < face.other_begin; ++n) {
    const std::int32_t from = node[n].from;
    const double v = from >= 0 ? own[from] : own_wall[-1 - from];
    mean += node[n].mean * v;
    slope += node[n].slope * v;
    ascent += node[n].ascent * v;
    least = std::min(least, v);
    most = std::max(most, v);
  }
  const double* other = u.component[face.other].data();
  const double* other_wall = geometry.wall.velocity[face.other].data();
  double other_here = 0.0;
  double other_slope = 0.0;
  for (std::int32_t n = face.other_begin; n < face.end; ++n) {
    const std::int32_t from = node[n].from;
    const double v = from >= 0 ? other[from] : other_wall[-1 - from];
    other_here += node[n].mean * v;
    other_slope += node[n].slope * v;
  }
  const double along = here * face.own_part + other_here * face.other_part;
  // From continuity, for a tight surface that does not stretch; docs/theory/fluid.md, eq. (12).
  // Interpolated, the velocity across a layer of one cell would be an error of that along it.
  const double stretch =
      face.own_part * slope + face.other_part * other_slope + stretch_along(grid, face, u, d);
  const double across = -0.5 * face.distance * stretch;
  const double rate = (std::abs(along) + std::abs(across)) * face.inverse_length;
  const double change = along * slope + across * ascent + k_dissipation * rate * (here - mean);
  const double in_layer = std::clamp(change, rate * (here - most), rate * (here - least));
  const double share = share_of_layer(geometry, face, along, d);
  return share * in_layer + (1.0 - share) * along_grid;
}

}  // namespace dust::fluid

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

}  // namespace

double convection_along_surface(const Grid& grid, const Geometry& geometry, const SkewFace& face,
                                const FaceField& u, int d) {
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
  return std::clamp(change, rate * (here - most), rate * (here - least));
}

}  // namespace dust::fluid

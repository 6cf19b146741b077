// SPDX-License-Identifier: Apache-2.0
#include "fluid/geometry/geometry.hpp"

#include "fluid/geometry/geometry_builder.hpp"

#include <algorithm>
#include <cmath>

namespace dust::fluid {
namespace {

/// Distance from the surfaces (in cells) beyond which no thin body can come between two neighbours.
constexpr double k_near = 1.8;

}  // namespace

GeometryBuilder::GeometryBuilder(const Grid& grid, const bodies::BodySet& bodies,
                                 const SideKinds& sides, const FaceProperties& properties,
                                 TimeInterval interval, const Geometry* standing,
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

Geometry GeometryBuilder::build() {
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
  find_skew();
  sort_wall_points();
  return std::move(g_);
}

void evaluate(WallPoints& wall, const bodies::BodySet& bodies, double time) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::size_t first = wall.body_begin[b];
    const std::size_t count = wall.body_begin[b + 1] - first;
    if (count == 0 || bodies[b].motions.empty()) continue;
    bodies[b].surface_velocities({.count = count,
                                  .time = time,
                                  .axis = {},
                                  .x = &wall.x[first],
                                  .y = &wall.y[first],
                                  .z = &wall.z[first],
                                  .normal_x = &wall.normal_x[first],
                                  .normal_y = &wall.normal_y[first],
                                  .normal_z = &wall.normal_z[first],
                                  .velocity_x = &wall.velocity[0][first],
                                  .velocity_y = &wall.velocity[1][first],
                                  .velocity_z = &wall.velocity[2][first]});
  }
}

Geometry build_geometry(const Grid& grid, const bodies::BodySet& bodies, const SideKinds& sides,
                        const FaceProperties& properties, TimeInterval interval,
                        const Geometry* standing) {
  return GeometryBuilder(grid, bodies, sides, properties, interval, standing, BodyField::Which::all)
      .build();
}

Geometry build_static_geometry(const Grid& grid, const bodies::BodySet& bodies,
                               const SideKinds& sides, const FaceProperties& properties) {
  return GeometryBuilder(grid, bodies, sides, properties, {}, nullptr, BodyField::Which::standing)
      .build();
}

CellField open_fractions(const Grid& grid, const bodies::BodySet& bodies, const SideKinds& sides,
                         const FaceProperties& properties, double time, const Geometry& standing) {
  GeometryBuilder builder(grid, bodies, sides, properties, {time, time}, &standing,
                          BodyField::Which::all);
  builder.measure_cells();
  return builder.take_open_fraction();
}

}  // namespace dust::fluid

// SPDX-License-Identifier: Apache-2.0
#include "fluid/geometry/geometry.hpp"

#include "fluid/geometry/geometry_builder.hpp"
#include "fluid/pressure/continuity.hpp"

namespace dust::fluid {

void evaluate(WallPoints& wall, const bodies::BodySet& bodies, double time) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::size_t first = wall.body_begin[b];
    const std::size_t count = wall.body_begin[b + 1] - first;
    if (count == 0 || bodies[b].motions.empty()) continue;
    bodies[b].surface_velocities(
        {.count = count,
         .time = time,
         .axis = {},
         .position = {&wall.x[first], &wall.y[first], &wall.z[first]},
         .normal = {&wall.normal_x[first], &wall.normal_y[first], &wall.normal_z[first]},
         .velocity = {&wall.velocity[0][first], &wall.velocity[1][first],
                      &wall.velocity[2][first]}});
  }
}

Geometry build_geometry(const Grid& grid, const bodies::BodySet& bodies, const SideKinds& sides,
                        const FaceProperties& properties, TimeInterval interval,
                        const Geometry* static_geometry) {
  return GeometryBuilder(grid, bodies, sides, properties, interval, static_geometry,
                         BodyField::Which::all)
      .build();
}

Geometry build_static_geometry(const Grid& grid, const bodies::BodySet& bodies,
                               const SideKinds& sides, const FaceProperties& properties) {
  return GeometryBuilder(grid, bodies, sides, properties, {}, nullptr,
                         BodyField::Which::static_bodies)
      .build();
}

FaceField passable_area(const Grid& grid, const Geometry& geometry) {
  FaceField area = geometry.open_area;
  for (const BlockedFace& face : geometry.blocked) area.component[face.axis][face.at] = 0.0;
  for (int d = 0; d < 3; ++d) {
    if (grid.is_periodic[d]) wrap_last_face(grid, d, area.component[d]);
  }
  return area;
}

CellField open_fractions(const Grid& grid, const bodies::BodySet& bodies, const SideKinds& sides,
                         const FaceProperties& properties, double time,
                         const Geometry& static_geometry) {
  GeometryBuilder builder(grid, bodies, sides, properties, {time, time}, &static_geometry,
                          BodyField::Which::all);
  builder.measure_cells();
  return builder.take_open_fraction();
}

}  // namespace dust::fluid

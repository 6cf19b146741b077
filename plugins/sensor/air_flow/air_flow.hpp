// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/fluid_faces.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dust::model::air_flow {

/// What of the air passes a rectangle, along the axis that it lies across.
struct Passing {
  double forward = 0.0;   ///< [m3/s] where it goes along the axis
  double backward = 0.0;  ///< [m3/s] where it goes against it; not below 0
  double area = 0.0;      ///< [m2] open to the air
  /// [m/s] Velocity along the axis between the grains, over the open part; sdk::k_no_value where
  /// nothing is open.
  double lowest = sdk::k_no_value;
  double highest = sdk::k_no_value;  ///< [m/s]
  [[nodiscard]] double net() const { return forward - backward; }
  [[nodiscard]] double mean_velocity() const { return area > 0.0 ? net() / area : sdk::k_no_value; }
};

/// [m] Length that a cell's edge [low, low + spacing] shares with [min, max].
inline double shared(double low, double spacing, double min, double max) {
  return std::max(0.0, std::min(low + spacing, max) - std::max(low, min));
}

/// The faces of one column of cells round the rectangle, one on either side of it.
struct ColumnFlow {
  double flux = 0.0;      ///< [m/s] over the whole area
  double open = 0.0;      ///< [-] share open to the air
  double velocity = 0.0;  ///< [m/s] between the grains
  bool has_velocity = false;
};

/// Linear between the two faces, as continuity has it. Faces less than half open have a flux but
/// say nothing of the velocity.
inline ColumnFlow between(const sdk::FluidFaces& faces, std::size_t low, std::size_t high,
                          double part) {
  ColumnFlow found;
  double passing = 0.0, room = 0.0;
  for (const bool is_high : {false, true}) {
    const double weight = is_high ? part : 1.0 - part;
    const std::size_t face = is_high ? high : low;
    if (weight == 0.0) continue;
    found.flux += weight * faces.flux(face);
    found.open += weight * faces.open(face);
    if (faces.open(face) < 0.5) continue;
    passing += weight * faces.flux(face);
    room += weight * faces.open(face) * faces.void_fraction(face);
  }
  found.has_velocity = room > 0.0;
  if (found.has_velocity) found.velocity = passing / room;
  return found;
}

/// Through the rectangle between `min` and `max`, which lies across `axis` at min[axis]: faces that
/// it cuts count with their part in it. Columns of cells that have less than half of their edge in
/// it say nothing of the lowest and the highest velocity.
inline Passing through(const sdk::FluidColumns& fluid, int axis, sdk::Vec3 min, sdk::Vec3 max) {
  const sdk::FluidFaces faces(fluid, axis);
  const int e = (axis + 1) % 3, f = (axis + 2) % 3;
  const sdk::FluidFaces::Planes planes = faces.planes(min[axis]);
  Passing found;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  int at[3];
  const auto face_in = [&](int plane) {
    at[axis] = plane;
    return faces.index(at[0], at[1], at[2]);
  };
  for (at[f] = 0; at[f] < fluid.count[f]; ++at[f]) {
    for (at[e] = 0; at[e] < fluid.count[e]; ++at[e]) {
      const auto edge = [&](int d) {
        return shared(fluid.origin[d] + at[d] * fluid.spacing[d], fluid.spacing[d], min[d], max[d]);
      };
      const double part = edge(e) * edge(f);
      if (!(part > 0.0)) continue;
      const std::size_t low = face_in(planes.low);
      const ColumnFlow here = between(faces, low, face_in(planes.high), planes.part);
      (here.flux > 0.0 ? found.forward : found.backward) += part * std::abs(here.flux);
      found.area += part * here.open;
      const bool is_mostly_in =
          edge(e) >= 0.5 * fluid.spacing[e] && edge(f) >= 0.5 * fluid.spacing[f];
      if (!here.has_velocity || !is_mostly_in) continue;
      lowest = std::min(lowest, here.velocity);
      highest = std::max(highest, here.velocity);
    }
  }
  if (lowest <= highest) {
    found.lowest = lowest;
    found.highest = highest;
  }
  return found;
}

}  // namespace dust::model::air_flow

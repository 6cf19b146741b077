// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/fluid_cells.hpp>

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
  double lowest = 0.0;    ///< [m/s] velocity along the axis between the grains, over the open part
  double highest = 0.0;   ///< [m/s]
  [[nodiscard]] double net() const { return forward - backward; }
  [[nodiscard]] double mean_velocity() const { return area > 0.0 ? net() / area : 0.0; }
};

/// [m] Length that a cell's edge [low, low + spacing] shares with [min, max].
inline double shared(double low, double spacing, double min, double max) {
  return std::max(0.0, std::min(low + spacing, max) - std::max(low, min));
}

/// Through the rectangle between `min` and `max`, which lies across `axis` at min[axis]: cells that
/// it cuts count with their part in it, closed parts not at all, linear between the layers of
/// cells. Cells that have less than half of their edge in it say nothing of the lowest and the
/// highest velocity.
inline Passing through(const sdk::FluidColumns& fluid, int axis, sdk::Vec3 min, sdk::Vec3 max) {
  const sdk::FluidCells cells(fluid);
  const std::span<const float> u = axis == 0   ? fluid.velocity_x
                                   : axis == 1 ? fluid.velocity_y
                                               : fluid.velocity_z;
  const int e = (axis + 1) % 3, f = (axis + 2) % 3;
  const sdk::FluidCells::Layers layers = cells.layers(axis, min[axis]);
  Passing found;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  int at[3];
  for (at[f] = 0; at[f] < fluid.count[f]; ++at[f]) {
    for (at[e] = 0; at[e] < fluid.count[e]; ++at[e]) {
      const auto edge = [&](int d) {
        return shared(fluid.origin[d] + at[d] * fluid.spacing[d], fluid.spacing[d], min[d], max[d]);
      };
      const double part = edge(e) * edge(f);
      if (!(part > 0.0)) continue;
      double flux = 0.0, velocity = 0.0, open = 0.0, weights = 0.0;
      for (const bool is_high : {false, true}) {
        const double weight = is_high ? layers.part : 1.0 - layers.part;
        at[axis] = is_high ? layers.high : layers.low;
        const std::size_t c = cells.index(at[0], at[1], at[2]);
        if (weight == 0.0 || !cells.is_open(c)) continue;
        const double share = weight * static_cast<double>(fluid.open_fraction[c]);
        flux += share * static_cast<double>(fluid.void_fraction[c]) * static_cast<double>(u[c]);
        velocity += weight * static_cast<double>(u[c]);
        open += share;
        weights += weight;
      }
      if (!(weights > 0.0)) continue;
      (flux > 0.0 ? found.forward : found.backward) += part * std::abs(flux);
      found.area += part * open;
      const bool is_mostly_in =
          edge(e) >= 0.5 * fluid.spacing[e] && edge(f) >= 0.5 * fluid.spacing[f];
      if (!is_mostly_in) continue;
      lowest = std::min(lowest, velocity / weights);
      highest = std::max(highest, velocity / weights);
    }
  }
  if (lowest <= highest) {
    found.lowest = lowest;
    found.highest = highest;
  }
  return found;
}

}  // namespace dust::model::air_flow

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace dust::sdk {

/// The cells of FluidColumns by place. Columns hold numbers of cell centres; beyond the outermost
/// centres they are continued as they are there. Cells with less than half their room count as
/// solid.
class FluidCells {
 public:
  explicit FluidCells(const FluidColumns& fluid) : f_(fluid) {}

  [[nodiscard]] bool is_empty() const { return f_.pressure.empty(); }
  [[nodiscard]] std::size_t size() const { return f_.pressure.size(); }
  [[nodiscard]] int count(int d) const { return f_.count[d]; }
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(f_.count[0]) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(f_.count[1]) * static_cast<std::size_t>(k));
  }
  [[nodiscard]] bool is_open(std::size_t cell) const { return f_.open_fraction[cell] >= 0.5f; }
  [[nodiscard]] Vec3 centre(int i, int j, int k) const {
    return {f_.origin.x + (i + 0.5) * f_.spacing.x, f_.origin.y + (j + 0.5) * f_.spacing.y,
            f_.origin.z + (k + 0.5) * f_.spacing.z};
  }
  /// Index along d of the cell that holds `x` [m], taken into the grid.
  [[nodiscard]] int cell_at(int d, double x) const {
    const double s = std::floor((x - f_.origin[d]) / f_.spacing[d]);
    return static_cast<int>(std::clamp(s, 0.0, static_cast<double>(f_.count[d] - 1)));
  }

  /// Two layers of cells round a place along one direction, and the share of the upper one.
  struct Layers {
    int low = 0;
    int high = 0;
    double part = 0.0;
  };
  [[nodiscard]] Layers layers(int d, double x) const {
    const double s = (x - f_.origin[d]) / f_.spacing[d] - 0.5;
    const double last = f_.count[d] - 1;
    const double inside = std::clamp(s, 0.0, last);
    const int low = std::min(static_cast<int>(inside), std::max(0, f_.count[d] - 2));
    return {low, std::min(low + 1, f_.count[d] - 1), inside - low};
  }

  /// Linear in place between the open cells around; 0 where none is open.
  template <class Value>
  [[nodiscard]] double at(Vec3 point, const Value& value) const {
    const Layers l[3] = {layers(0, point.x), layers(1, point.y), layers(2, point.z)};
    double sum = 0.0;
    double weights = 0.0;
    for (int n = 0; n < 8; ++n) {
      double weight = 1.0;
      int cell[3];
      for (int d = 0; d < 3; ++d) {
        const bool is_high = ((n >> d) & 1) != 0;
        weight *= is_high ? l[d].part : 1.0 - l[d].part;
        cell[d] = is_high ? l[d].high : l[d].low;
      }
      const std::size_t c = index(cell[0], cell[1], cell[2]);
      if (weight == 0.0 || !is_open(c)) continue;
      sum += weight * value(c);
      weights += weight;
    }
    return weights > 0.0 ? sum / weights : 0.0;
  }
  [[nodiscard]] double at(Vec3 point, std::span<const float> column) const {
    return at(point, [&](std::size_t c) { return static_cast<double>(column[c]); });
  }

  /// Sums over one layer across d: of the value times the open share, and of the open shares.
  struct LayerSum {
    double sum = 0.0;
    double open = 0.0;  ///< of as many as the layer has cells
  };
  template <class Value>
  [[nodiscard]] LayerSum layer(int d, int at, const Value& value) const {
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    LayerSum s;
    int cell[3];
    cell[d] = at;
    for (cell[f] = 0; cell[f] < f_.count[f]; ++cell[f]) {
      for (cell[e] = 0; cell[e] < f_.count[e]; ++cell[e]) {
        const std::size_t c = index(cell[0], cell[1], cell[2]);
        if (!is_open(c)) continue;
        const double open = f_.open_fraction[c];
        s.sum += open * value(c);
        s.open += open;
      }
    }
    return s;
  }
  /// Mean over the open part of the plane across d at `x`, linear between the layers; 0 where
  /// nothing is open.
  template <class Value>
  [[nodiscard]] double plane_mean(int d, double x, const Value& value) const {
    const Layers l = layers(d, x);
    const LayerSum low = layer(d, l.low, value);
    const LayerSum high = layer(d, l.high, value);
    if (!(low.open > 0.0) || !(high.open > 0.0)) {
      const LayerSum& s = low.open > 0.0 ? low : high;
      return s.open > 0.0 ? s.sum / s.open : 0.0;
    }
    return (1.0 - l.part) * low.sum / low.open + l.part * high.sum / high.open;
  }
  /// Volume flow along d through the plane over its whole area [m/s], solids included: what a flow
  /// meter in front of an empty vessel of this section would show.
  [[nodiscard]] double superficial_velocity(int d, double x) const {
    const std::span<const float> u = d == 0   ? f_.velocity_x
                                     : d == 1 ? f_.velocity_y
                                              : f_.velocity_z;
    const auto flux = [&](std::size_t c) {
      return static_cast<double>(f_.void_fraction[c]) * static_cast<double>(u[c]);
    };
    const Layers l = layers(d, x);
    const double cells = static_cast<double>(f_.count[(d + 1) % 3]) * f_.count[(d + 2) % 3];
    return ((1.0 - l.part) * layer(d, l.low, flux).sum + l.part * layer(d, l.high, flux).sum) /
           cells;
  }

 private:
  const FluidColumns& f_;
};

/// The axis along which two points differ alone; -1 where they differ along none or several.
inline int common_axis(Vec3 from, Vec3 to) {
  int axis = -1;
  for (int d = 0; d < 3; ++d) {
    if (from[d] == to[d]) continue;
    if (axis >= 0) return -1;
    axis = d;
  }
  return axis;
}

}  // namespace dust::sdk

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <span>
#include <unordered_map>
#include <vector>

namespace dust::model::feed {

/// A grain of the stream in the frame that moves with it, where all of them stand still.
struct StreamGrain {
  double time = 0.0;  ///< [s] when it passes the opening
  sdk::Vec3 centre;   ///< [m] in the moving frame, which is the domain's at time 0
  double radius = 0.0;
};

/// The grains placed so far, found by cells. One grid per halving of the diameter: a large grain
/// meets few cells of large ones, not many of small ones.
class PlacedStream {
 public:
  /// `largest`: [m] diameter.
  explicit PlacedStream(double largest) {
    for (std::size_t n = 0; n < k_levels; ++n) {
      levels_[n].edge = std::ldexp(largest, -static_cast<int>(n));
    }
  }

  void add(const StreamGrain& grain) {
    Level& level = levels_[level_of(grain.radius)];
    level.cells[key_of(cell_of(grain.centre, level.edge))].push_back(grain);
    ++level.count;
  }

  /// [m] Upper end of the sizes that share a grid with a sphere: its diameter and up to twice that.
  [[nodiscard]] double level_diameter(double radius) const {
    return levels_[level_of(radius)].edge;
  }

  /// Whether the sphere touches none of those that are not of a smaller level than its own; `gap`
  /// [-] of the sum of the radii stays free.
  [[nodiscard]] bool is_free(sdk::Vec3 centre, double radius, double gap) const {
    for (std::size_t n = 0; n <= level_of(radius); ++n) {
      if (levels_[n].count > 0 && !is_free_in(levels_[n], centre, radius, gap)) return false;
    }
    return true;
  }

  /// Drops the grains that passed before `time` [s].
  void drop_before(double time) {
    for (Level& level : levels_) {
      level.count = 0;
      for (auto cell = level.cells.begin(); cell != level.cells.end();) {
        std::erase_if(cell->second, [time](const StreamGrain& g) { return g.time < time; });
        level.count += cell->second.size();
        cell = cell->second.empty() ? level.cells.erase(cell) : std::next(cell);
      }
    }
  }

  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Level& level : levels_) {
      for (const auto& [key, grains] : level.cells) {
        for (const StreamGrain& g : grains) visit(g);
      }
    }
  }

 private:
  static constexpr std::size_t k_levels = 24;
  using Cell = std::array<std::int64_t, 3>;
  struct Level {
    double edge = 1.0;  ///< [m] of a cell: the largest diameter of the level
    std::size_t count = 0;
    std::unordered_map<std::uint64_t, std::vector<StreamGrain>> cells;
  };

  [[nodiscard]] std::size_t level_of(double radius) const {
    std::size_t n = 0;
    while (n + 1 < k_levels && 2.0 * radius <= levels_[n + 1].edge) ++n;
    return n;
  }
  static Cell cell_of(sdk::Vec3 x, double edge) {
    return {static_cast<std::int64_t>(std::floor(x.x / edge)),
            static_cast<std::int64_t>(std::floor(x.y / edge)),
            static_cast<std::int64_t>(std::floor(x.z / edge))};
  }
  /// Cells that share a key cost time, not correctness.
  static std::uint64_t key_of(const Cell& c) {
    return static_cast<std::uint64_t>(c[0]) * 0x9E3779B97F4A7C15ull ^
           static_cast<std::uint64_t>(c[1]) * 0xC2B2AE3D27D4EB4Full ^
           static_cast<std::uint64_t>(c[2]) * 0x165667B19E3779F9ull;
  }

  /// Both radii are at most half an edge: neighbouring cells hold all that can touch.
  static bool is_free_in(const Level& level, sdk::Vec3 centre, double radius, double gap) {
    const Cell centre_cell = cell_of(centre, level.edge);
    for (std::int64_t k = -1; k <= 1; ++k) {
      for (std::int64_t j = -1; j <= 1; ++j) {
        for (std::int64_t i = -1; i <= 1; ++i) {
          const auto found = level.cells.find(
              key_of({centre_cell[0] + i, centre_cell[1] + j, centre_cell[2] + k}));
          if (found == level.cells.end()) continue;
          for (const StreamGrain& g : found->second) {
            const sdk::Vec3 apart = centre - g.centre;
            const double reach = (radius + g.radius) * (1.0 + gap);
            if (dot(apart, apart) < reach * reach) return false;
          }
        }
      }
    }
    return true;
  }

  std::array<Level, k_levels> levels_;
};

/// Of a stream with `flows` [1/s] grains of each of `diameters` [m]: how many grains a random place
/// for the largest one would meet on average. One in exp(n) places is free.
inline double met_by_largest(std::span<const double> diameters, std::span<const double> flows,
                             double area, double speed) {
  double largest = 0.0;
  for (const double d : diameters) largest = std::max(largest, d);
  double met = 0.0;
  for (std::size_t i = 0; i < diameters.size(); ++i) {
    const double reach = 0.5 * (largest + diameters[i]);
    met += flows[i] / (area * speed) * 4.0 / 3.0 * std::numbers::pi * reach * reach * reach;
  }
  return met;
}

}  // namespace dust::model::feed

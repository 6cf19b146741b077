// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/grid_shape.hpp>
#include <dust/sdk/sampling.hpp>
#include <dust/sdk/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace dust::model::wear {

/// [m3] Volume worn off by what slides: \f$ V = k \int F_n v_t\, dt / H \f$ (Archard 1953).
/// @param coefficient  [-] k, of the pair of materials and how abrasive the contact is
/// @param hardness     [Pa] H of the surface that wears
/// @param sliding      [J] normal force times the way slid, summed over the way
constexpr double archard(double coefficient, double hardness, double sliding) {
  return coefficient * sliding / hardness;
}

/// Wear and pressure of cubes, with the scatter of each over time. Only those that a grain has
/// touched take memory.
class Places {
 public:
  static constexpr std::size_t k_worn = 0;     ///< volume over the area of a cube's face [m]
  static constexpr std::size_t k_pressed = 1;  ///< impulse over the same [Pa s]

  Places(sdk::Vec3 origin, double edge) {
    grid_.origin = origin;
    grid_.spacing = {edge, edge, edge};
  }
  void set_count(int direction, int count) { grid_.count[direction] = count; }
  [[nodiscard]] const sdk::GridShape& grid() const { return grid_; }

  /// At a place in the box: volume [m3] and normal impulse [N s].
  void add(sdk::Vec3 place, double worn, double impulse) {
    std::int64_t cell = 0;
    for (int d = 2; d >= 0; --d) {
      const int n = static_cast<int>((place[d] - grid_.origin[d]) / grid_.spacing[d]);
      cell = cell * grid_.count[d] + std::min(n, grid_.count[d] - 1);
    }
    const auto [at, is_new] = index_.try_emplace(cell, cells_.size());
    if (is_new) {
      cells_.push_back(cell);
      sums_.resize(k_columns * cells_.size(), 0.0);
      means_.widen(sums_.size());
    }
    const double area = grid_.spacing[0] * grid_.spacing[1];
    sums_[k_columns * at->second + k_worn] += worn / area;
    sums_[k_columns * at->second + k_pressed] += impulse / area;
  }
  /// Ends an interval [s]: what was added becomes a sample of rates.
  void close(double interval) {
    for (double& sum : sums_) sum /= interval;
    means_.add(sums_, interval);
    std::fill(sums_.begin(), sums_.end(), 0.0);
  }

  struct Place {
    double mean = 0.0;
    double error = sdk::k_no_estimate;
    sdk::Vec3 middle;
  };
  /// The place of the largest mean; 0 where nothing is touched, no value before the first sample.
  [[nodiscard]] Place largest(std::size_t column) const {
    Place best;
    if (!(means_.duration() > 0.0)) best.mean = sdk::k_no_value;
    for (std::size_t n = 0; n < cells_.size(); ++n) {
      const double mean = means_.mean(k_columns * n + column);
      if (!(mean > best.mean)) continue;
      best = {mean, means_.error(k_columns * n + column), middle(cells_[n])};
    }
    return best;
  }
  /// Of all cells of the grid.
  [[nodiscard]] std::vector<double> means(std::size_t column) const {
    const auto count = [this](int d) { return static_cast<std::size_t>(grid_.count[d]); };
    std::vector<double> all(count(0) * count(1) * count(2), 0.0);
    for (std::size_t n = 0; n < cells_.size(); ++n) {
      all[static_cast<std::size_t>(cells_[n])] = means_.mean(k_columns * n + column);
    }
    return all;
  }

  void save(sdk::ArchiveWriter& archive) const {
    archive.integers("cells", cells_);
    means_.save(archive, "places");
  }
  void load(sdk::ArchiveReader& archive) {
    cells_ = archive.integers("cells");
    means_.load(archive, "places");
    index_.clear();
    for (std::size_t n = 0; n < cells_.size(); ++n) index_[cells_[n]] = n;
    sums_.assign(k_columns * cells_.size(), 0.0);
  }

 private:
  static constexpr std::size_t k_columns = 2;

  [[nodiscard]] sdk::Vec3 middle(std::int64_t cell) const {
    sdk::Vec3 point;
    for (int d = 0; d < 3; ++d) {
      const auto n = static_cast<double>(cell % grid_.count[d]);
      point[d] = grid_.origin[d] + (n + 0.5) * grid_.spacing[d];
      cell /= grid_.count[d];
    }
    return point;
  }

  sdk::GridShape grid_;
  std::vector<std::int64_t> cells_;  ///< touched, in the order in which they were
  std::unordered_map<std::int64_t, std::size_t> index_;  ///< in `cells_`
  std::vector<double> sums_;  ///< since the last sample, k_columns per cell
  sdk::BatchMeans means_;
};

}  // namespace dust::model::wear

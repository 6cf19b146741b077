// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/transport.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace dust::test {

using airborne::DustClass;
using airborne::Flow;
using airborne::GasAcceleration;
using airborne::Losses;
using airborne::Transport;
using fluid::CellField;
using fluid::Grid;
using sdk::Vec3;

/// A box of gas that moves as told, and one class of dust in it.
class Box {
 public:
  Box(std::array<int, 3> cells, Vec3 max, std::array<bool, 3> periodic)
      : grid_(Grid::make({0, 0, 0}, max, cells, periodic)), flow_(grid_), mass_(grid_.size, 0.0) {
    each_cell([&](std::size_t cell, Vec3) {
      flow_.volume_before[cell] = flow_.volume_after[cell] = 1.0;
    });
    for (int d = 0; d < 3; ++d) {
      each_face(d, [&](std::size_t face, Vec3, bool is_side) {
        flow_.passage.component[d][face] = is_side ? 0.0 : 1.0;
      });
    }
  }

  [[nodiscard]] const Grid& grid() const { return grid_; }
  [[nodiscard]] Flow& flow() { return flow_; }
  [[nodiscard]] CellField& mass() { return mass_; }
  [[nodiscard]] const Losses& losses() const { return losses_; }
  [[nodiscard]] DustClass& dust() { return dust_; }

  void each_cell(const std::function<void(std::size_t, Vec3)>& visit) const {
    for (int k = 0; k < grid_.count[2]; ++k) {
      for (int j = 0; j < grid_.count[1]; ++j) {
        for (int i = 0; i < grid_.count[0]; ++i) {
          visit(static_cast<std::size_t>(grid_.index(i, j, k)), grid_.centre(i, j, k));
        }
      }
    }
  }
  void each_face(int d, const std::function<void(std::size_t, Vec3, bool)>& visit) const {
    std::array<int, 3> n = grid_.count;
    n[static_cast<std::size_t>(d)] += 1;
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) {
          const int at[3] = {i, j, k};
          const bool is_side = !grid_.is_periodic[d] && (at[d] == 0 || at[d] == grid_.count[d]);
          visit(static_cast<std::size_t>(grid_.index(i, j, k)), grid_.face(d, i, j, k), is_side);
        }
      }
    }
  }
  void set_velocity(const std::function<Vec3(Vec3)>& velocity) {
    for (int d = 0; d < 3; ++d) {
      each_face(d, [&](std::size_t face, Vec3 x, bool is_side) {
        flow_.throughflow.component[d][face] =
            is_side ? 0.0 : flow_.passage.component[d][face] * velocity(x)[d];
      });
    }
  }
  void set_mass(const std::function<double(Vec3)>& value) {
    each_cell([&](std::size_t cell, Vec3 x) { mass_[cell] = flow_.volume_after[cell] * value(x); });
  }
  void add_floor() {
    for (int j = 0; j < grid_.count[1]; ++j) {
      for (int i = 0; i < grid_.count[0]; ++i) {
        flow_.walls.push_back(
            {static_cast<std::int32_t>(grid_.index(i, j, 0)), 0, {0, 0, -1.0 / grid_.spacing.z}});
      }
    }
  }
  /// A floor that holds grains, through which gas comes in at `speed` [m/s].
  void add_sieve(double speed) {
    for (int j = 0; j < grid_.count[1]; ++j) {
      for (int i = 0; i < grid_.count[0]; ++i) {
        const auto cell = static_cast<std::int32_t>(grid_.index(i, j, 0));
        flow_.walls.push_back({cell, 4, {0, 0, -1.0 / grid_.spacing.z}, cell});
        flow_.throughflow.component[2][static_cast<std::size_t>(cell)] = speed;
      }
    }
  }
  void run(double end, int steps) {
    Transport transport(grid_);
    transport.prepare(flow_);
    losses_.outlets.resize(2, 0.0);
    for (int n = 0; n < steps; ++n) {
      transport.advance(flow_, dust_, 1.0, {}, end / steps, mass_, losses_);
    }
  }
  /// With the drift by inertia; `change` sets the gas of a step. Returns the largest share of cells
  /// in which the drift was limited.
  double run_with_inertia(double end, int steps, const std::function<void(int)>& change = {}) {
    Transport transport(grid_);
    GasAcceleration acceleration(grid_, std::abs(dust_.inertia_time));
    losses_.outlets.resize(2, 0.0);
    double limited = 0.0;
    for (int n = 0; n < steps; ++n) {
      if (change) change(n);
      acceleration.find(flow_, end / steps);
      transport.prepare(flow_, &acceleration);
      transport.advance(flow_, dust_, 1.0, {}, end / steps, mass_, losses_);
      double cells = 0.0;
      each_cell(
          [&](std::size_t cell, Vec3) { cells += static_cast<double>(transport.limited()[cell]); });
      limited = std::max(limited, cells / (grid_.count[0] * grid_.count[1] * grid_.count[2]));
    }
    return limited;
  }
  /// Centre of the dust's mass.
  [[nodiscard]] Vec3 middle() const {
    Vec3 sum;
    each_cell([&](std::size_t cell, Vec3 x) { sum += mass_[cell] * x; });
    return sum / in_air();
  }
  [[nodiscard]] double in_air() const {
    double sum = 0.0;
    each_cell([&](std::size_t cell, Vec3) { sum += mass_[cell]; });
    return sum;
  }
  [[nodiscard]] double lost() const {
    return std::accumulate(losses_.sides.begin(), losses_.sides.end(), 0.0) +
           std::accumulate(losses_.outlets.begin(), losses_.outlets.end(), 0.0) +
           std::accumulate(losses_.walls.begin(), losses_.walls.end(), 0.0);
  }

 private:
  Grid grid_;
  Flow flow_;
  CellField mass_;
  DustClass dust_;
  Losses losses_;
};

inline double smooth_blob(Vec3 x, Vec3 centre, double radius) {
  const double r = std::min(norm(x - centre) / radius, 1.0);
  return std::pow(std::cos(0.5 * std::numbers::pi * r), 4);
}

}  // namespace dust::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/boundary_condition.hpp"
#include "dust/sdk/side_flow.hpp"
#include "registry/registry.hpp"
#include "setup/setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dust::preflight {

/// The air's models of the six sides, in the order of scenario::k_side_names; null where periodic
/// or wrong.
class SideModels {
 public:
  SideModels() = default;
  SideModels(std::array<const sdk::BoundaryCondition*, 6> models, std::vector<double> corners)
      : models_(models), corners_(std::move(corners)) {}
  const sdk::BoundaryCondition* operator[](std::size_t side) const { return models_[side]; }
  [[nodiscard]] auto begin() const { return models_.begin(); }
  [[nodiscard]] auto end() const { return models_.end(); }
  /// [s] All times among the parameters of the models: what they drive may turn there.
  [[nodiscard]] const std::vector<double>& corners() const { return corners_; }

 private:
  std::array<const sdk::BoundaryCondition*, 6> models_{};
  std::vector<double> corners_;
};

/// Makes them.
class SideModelSet {
 public:
  SideModelSet(const scenario::Setup& setup, const registry::Registry& registry);
  [[nodiscard]] const SideModels& models() const { return models_; }

 private:
  std::array<std::unique_ptr<sdk::BoundaryCondition>, 6> made_;
  SideModels models_{};
};

/// The faces of one side as the fluid has them, without bodies and grains: x before y before z.
class SideFaces {
 public:
  SideFaces(const scenario::Setup& setup, std::size_t side);
  // The batch points into the columns.
  SideFaces(const SideFaces&) = delete;
  SideFaces& operator=(const SideFaces&) = delete;

  static std::size_t count_of(const scenario::Setup& setup, std::size_t side) {
    std::size_t count = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      if (a != side / 2) count *= static_cast<std::size_t>(setup.fluid->cells[a]);
    }
    return count;
  }
  /// Whether no region of another viscosity lies at the side.
  [[nodiscard]] bool is_of_own_fluid() const { return is_of_own_fluid_; }
  /// Lets a model write what it wants at `time`.
  void ask(const sdk::BoundaryCondition& model, double time) {
    clear();
    batch_.time = time;
    model.evaluate(batch_);
  }
  /// [m/s] largest component of what a model wrote
  [[nodiscard]] double largest_speed() const {
    double largest = 0.0;
    for (const auto& component : velocity_) {
      for (const double v : component) largest = std::max(largest, std::abs(v));
    }
    return largest;
  }
  /// Did a model let fluid pass any face?
  [[nodiscard]] bool is_passed() const {
    const auto& normal = velocity_[sdk::axis_of(batch_.normal)];
    return std::any_of(normal.begin(), normal.end(), [](double v) { return v != 0.0; });
  }
  /// Notes the faces that a model let fluid pass.
  void note_passed(std::vector<bool>& passed) const {
    const auto& normal = velocity_[sdk::axis_of(batch_.normal)];
    for (std::size_t n = 0; n < normal.size(); ++n) {
      if (normal[n] != 0.0) passed[n] = true;
    }
  }
  [[nodiscard]] bool is_passed_everywhere() const {
    const auto& normal = velocity_[sdk::axis_of(batch_.normal)];
    return std::all_of(normal.begin(), normal.end(), [](double v) { return v != 0.0; });
  }
  /// [m3/s] into the domain
  [[nodiscard]] double inflow() const {
    const int d = sdk::axis_of(batch_.normal);
    double sum = 0.0;
    for (std::size_t n = 0; n < batch_.count; ++n) {
      sum -= batch_.normal[d] * velocity_[d][n] * area_[n];
    }
    return sum;
  }

 private:
  /// Forgets what a model wrote.
  void clear() {
    for (auto& v : velocity_) v.assign(batch_.count, 0.0);
    pressure_.assign(batch_.count, 0.0);
  }

  sdk::SideBatch batch_;
  std::vector<double> x_, y_, z_, velocity_[3], pressure_, one_, density_, area_;
  bool is_of_own_fluid_ = true;
};

/// Whether a side has more faces than a check has memory for: it is left to the run.
[[nodiscard]] bool is_too_large(const scenario::Setup& setup, std::size_t side);

/// "domain.boundaries.left"
[[nodiscard]] std::string path_of_side(std::size_t side);

/// [s] Of the run at which flows are looked at, ascending: evenly over it, the end included, and
/// where the given course of one turns, of an opening of a body or of a side.
[[nodiscard]] std::vector<double> instants(const scenario::Setup& setup,
                                           const SideModels& sides = {});

}  // namespace dust::preflight

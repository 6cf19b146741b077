// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"
#include "particles/dem.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace dust::run {

/// The contacts as columns for sensors that want them, copied once per fluid step.
class ContactTable {
 public:
  /// `order`: the row of each published grain.
  void publish(const std::vector<particles::ContactRecord>& records,
               std::span<const std::size_t> order);
  [[nodiscard]] sdk::ContactColumns columns() const;

 private:
  std::vector<std::int32_t> grain_i_;
  std::vector<std::int32_t> grain_j_;
  std::vector<double> force_[3];
  std::vector<double> branch_[3];
  std::vector<double> overlap_;
  std::vector<double> wall_velocity_[3];
  std::vector<std::int32_t> place_;  ///< of each row among the published grains
};

}  // namespace dust::run

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/boundary_condition.hpp"

#include <cstddef>

namespace dust::test {

/// A side at which everything given is zero.
class StillSide final : public sdk::BoundaryCondition {
 public:
  explicit StillSide(sdk::SideRules r) : rules_(r) {}
  [[nodiscard]] sdk::SideRules rules() const override { return rules_; }
  void evaluate(const sdk::SideBatch& b) const override {
    for (std::size_t n = 0; n < b.count; ++n) {
      b.velocity.x[n] = b.velocity.y[n] = b.velocity.z[n] = b.pressure[n] = 0.0;
    }
  }

 private:
  sdk::SideRules rules_;
};

}  // namespace dust::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/grain_rows.hpp"
#include "setup/setup.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace dust::coupling {

/// Grains that stand for smaller ones: one of diameter D for l^3 of D / l, l that of its material
/// (`coarse_graining`). The fluid acts on each of these as on a grain of its own, and the row gets
/// the sum; docs/theory/coarse_graining.md, eq. (1).
class CoarseGraining {
 public:
  explicit CoarseGraining(std::span<const scenario::MaterialSpec> materials) {
    for (const scenario::MaterialSpec& m : materials) ratio_.push_back(m.coarse_graining);
    is_used_ = std::any_of(ratio_.begin(), ratio_.end(), [](double l) { return l != 1.0; });
  }
  /// l of a row [-], 1 for a grain that is itself.
  [[nodiscard]] double of(const particles::GrainRows& grains, std::size_t row) const {
    return is_used_ ? ratio_[static_cast<std::size_t>(grains.material[row])] : 1.0;
  }

 private:
  std::vector<double> ratio_;  ///< by material
  bool is_used_ = false;
};

}  // namespace dust::coupling

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <utility>
#include <vector>

namespace dust::report {

/// Which sizes of computed grains are dust, as the run says it (`dust_rule` of its report.json);
/// where it says nothing, what is finer than DustRule::k_usual_limit. Grains that stand for finer
/// ones are judged by those: the run lists its size classes with the answer.
class DustSizes {
 public:
  DustSizes();
  explicit DustSizes(const nlohmann::json& rule);

  [[nodiscard]] bool is_dust(double diameter) const;
  /// All dust is finer than this [m]: what the rule says, or else the finest size that is none.
  [[nodiscard]] double limit() const { return limit_; }

 private:
  [[nodiscard]] bool takes(double diameter) const;

  double limit_;
  std::vector<double> sizes_;                     ///< [m] that alone are dust; empty = all
  std::vector<std::pair<double, bool>> classes_;  ///< diameter [m], whether it is dust
};

}  // namespace dust::report

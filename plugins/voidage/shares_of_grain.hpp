// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/voidage_rule.hpp"

#include <cstddef>

namespace dust::model {

/// Writes the cells one grain is spread over, for rules whose shares add up to 1 but for rounding.
class SharesOfGrain {
 public:
  SharesOfGrain(const sdk::VoidageBatch& batch, std::size_t grain)
      : batch_(batch), grain_(grain), first_(grain * static_cast<std::size_t>(batch.capacity)) {}

  void add(int i, int j, int k, double weight) {
    batch_.cell_i[first_ + used_] = i;
    batch_.cell_j[first_ + used_] = j;
    batch_.cell_k[first_ + used_] = k;
    batch_.weight[first_ + used_] = weight;
    if (weight > batch_.weight[first_ + largest_]) largest_ = used_;
    ++used_;
  }
  /// The largest share becomes what the others leave, so that the sum is 1 to rounding.
  void close() {
    batch_.weight[first_ + largest_] = 0.0;
    double others = 0.0;
    for (std::size_t n = 0; n < used_; ++n) others += batch_.weight[first_ + n];
    batch_.weight[first_ + largest_] = 1.0 - others;
    batch_.used[grain_] = static_cast<int>(used_);
  }

 private:
  const sdk::VoidageBatch& batch_;
  std::size_t grain_;
  std::size_t first_;
  std::size_t used_ = 0;
  std::size_t largest_ = 0;
};

}  // namespace dust::model

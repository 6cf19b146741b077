// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "setup/setup.hpp"

#include <algorithm>

namespace dust::scenario {

/// Does a flow [m3/s] out of the domain, times the factors of its course if it has one, draw fluid
/// out at any time? One that only blows in does not.
inline bool draws_out(double flow, const std::vector<double>& factors) {
  if (factors.empty()) return flow > 0.0;
  return std::any_of(factors.begin(), factors.end(),
                     [flow](double factor) { return flow * factor > 0.0; });
}
inline bool draws_out(const SuctionSpec& suction) {
  return draws_out(suction.flow, suction.factors);
}

}  // namespace dust::scenario

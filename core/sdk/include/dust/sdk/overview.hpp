// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/figure_role.hpp>

namespace dust::sdk {

/// A detail that the first screen of the report shows under the sensor's name: what a reader asks
/// of this sensor before anything else. `rank` from 1 on is their order; the first stands largest.
constexpr FigureRole overview(Quantity quantity, int rank) {
  FigureRole role = detail(quantity);
  role.towards = "overview";
  role.index = rank;
  return role;
}

}  // namespace dust::sdk

// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model::pressure_drop {

/// A velocity along an axis as one from `from` towards `to` on that axis.
constexpr double along(double from, double to, double velocity) {
  return to > from ? velocity : -velocity;
}

}  // namespace dust::model::pressure_drop

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model {

/// How much stronger moisture binds dust than at the reference moisture, in [0, inf);
/// docs/theory/dust.md, eq. (10):
///   10^((M - M0) / M1)  for M1 > 0: a dust number that falls exponentially with moisture, as drum
///                       tests find (AS 4156.6, ISO 20905);
///   (M / M0)^1.4        else, AP-42, 13.2.4 (2006), there for 0.25 to 4.8 %.
/// M, M0, M1 [-] water over dry solids; in the second form M below `k_driest` counts as that, where
/// the fit ends.
inline double binding_by_moisture(double moisture, double reference, double scale) {
  constexpr double k_driest = 0.0025;
  if (scale > 0.0) return std::pow(10.0, (moisture - reference) / scale);
  return std::pow(std::fmax(moisture, k_driest) / std::fmax(reference, k_driest), 1.4);
}

}  // namespace dust::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::model::force_ratio {

/// Separation over binding force [-] of a dust particle of diameter d [m] and density rho [kg/m3]
/// whose grain is accelerated by a [m/s2] and that F_b [N] binds: pi/6 rho d^3 a / F_b;
/// docs/theory/dust.md, eq. (13).
inline double ratio(double diameter, double density, double acceleration, double binding) {
  return std::numbers::pi / 6.0 * density * diameter * diameter * diameter * acceleration / binding;
}

/// Share [-] of dust particles whose binding force lies below R times the median: binding forces
/// are log-normal with the geometric standard deviation sigma,
///   P = (1 + erf(ln R / (sqrt(2) ln sigma))) / 2.
inline double share_below(double ratio, double spread) {
  if (!(ratio > 0.0)) return 0.0;
  return 0.5 * std::erfc(-std::log(ratio) / (std::numbers::sqrt2 * std::log(spread)));
}

/// Dust [kg] that comes off a load m of a fresh load m_0 [kg] when the share P is set free that
/// R says: what has gone before was bound weakest,
///   dm = max(0, m - m_0 (1 - P(R))).
/// The ratio of forces as the measure of dustiness: Plinke, Leith, Boundy and Loeffler, Am. Ind.
/// Hyg. Assoc. J. 56 (1995) 251; docs/theory/dust.md, eq. (12).
inline double released(double load, double fresh, double share) {
  return std::max(0.0, load - fresh * (1.0 - share));
}

}  // namespace dust::model::force_ratio

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

/// Johnson, Kendall and Roberts' contact of two adhesive elastic spheres in numbers without
/// dimension. With \f$ L = (2 \pi \gamma R^{*2} / E^*)^{1/3} \f$, contact radius \f$ a = L b^2 \f$
/// and overlap \f$ d = D L^2 / R^* \f$ the two equations
/// \f$ d = a^2/R^* - \sqrt{2 \pi \gamma a / E^*} \f$,
/// \f$ F = \tfrac43 E^* a^3 / R^* - \sqrt{8 \pi \gamma E^* a^3} \f$ become \f$ D = b^4 - b \f$ and
/// \f$ F = \pi \gamma R^* (\tfrac83 b^6 - 4 b^3) \f$.
/// Source: Johnson, Kendall, Roberts, Proc. R. Soc. A 324 (1971) 301, doi:10.1098/rspa.1971.0141;
/// the solution for b: own derivation (Ferrari's resolvent).
namespace dust::model::jkr {

/// D at which a pair moved apart tears, where dD/db = 0 (b^3 = 1/4): -(27/256)^(1/3).
inline constexpr double k_tear = -0.47247039371057747;
/// b^3 at which the force is zero.
inline constexpr double k_rest_cubed = 1.5;

/// Length [m] L. `surface_energy` gamma [J/m2]: work to part a unit area of the two surfaces;
/// `young` E* [Pa], `radius` R* [m].
inline double length(double surface_energy, double young, double radius) {
  return std::cbrt(2.0 * std::numbers::pi * surface_energy * radius * radius / young);
}

/// The larger root b of b^4 - b = D for D >= k_tear: with the positive root m of
/// m^3 + D m - 1/8 = 0, b = (sqrt(2 m) + sqrt(sqrt(2/m) - 2 m)) / 2. Newton's iteration for m
/// begins above the root of a convex function, so it falls to it; eight steps reach rounding for
/// all D.
[[gnu::always_inline]] inline double root(double d) {
  constexpr double k_largest = 0.79370052598409974;  // m at k_tear
  double m = d > 0.0 ? std::min(k_largest, 0.125 / d) : k_largest;
  for (int n = 0; n < 8; ++n) m -= (m * (m * m + d) - 0.125) / (3.0 * m * m + d);
  return 0.5 * (std::sqrt(2.0 * m) + std::sqrt(std::max(std::sqrt(2.0 / m) - 2.0 * m, 0.0)));
}

/// One pair, in and out.
struct Bond {
  double overlap;   ///< [m] d
  double radius;    ///< [m] R*
  double length;    ///< [m] L
  double is_stuck;  ///< 1 from touch to tear, in and out
  double contact_overlap, attraction;
};

/// A contact begins at touch, d = 0, and ends where its neck tears, at
/// \f$ d = -0.4725 L^2/R^* \f$. In between the grains press on each other like Hertz spheres with
/// the contact radius a, that is at the overlap \f$ a^2/R^* \f$, and attract with
/// \f$ 4 \pi \gamma R^* b^3 = \sqrt{8 \pi \gamma E^* a^3} \f$.
[[gnu::always_inline]] inline void evaluate(double surface_energy, Bond& c) {
  const double unit = c.length * c.length / c.radius;
  const double d = c.overlap / unit;
  const bool is_stuck = c.overlap >= 0.0 || (c.is_stuck > 0.0 && d > k_tear);
  const double b = root(std::max(d, k_tear));
  const double b2 = b * b;
  c.contact_overlap = is_stuck ? unit * b2 * b2 : c.overlap;
  c.attraction = is_stuck ? (4.0 * std::numbers::pi) * surface_energy * c.radius * b * b2 : 0.0;
  c.is_stuck = is_stuck ? 1.0 : 0.0;
}

}  // namespace dust::model::jkr

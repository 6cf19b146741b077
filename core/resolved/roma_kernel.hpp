// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

namespace dust::resolved {

/// The regularised delta function of three points per direction (Roma, Peskin, Berger 1999,
/// 10.1006/jcph.1999.6293), `r` in spacings; docs/theory/resolved.md, eq. (4). Its values at points
/// one apart sum to one, and their mean place is where it stands.
[[nodiscard]] inline double roma(double r) {
  const double a = std::abs(r);
  if (a <= 0.5) return (1.0 + std::sqrt(1.0 - 3.0 * a * a)) / 3.0;
  if (a >= 1.5) return 0.0;
  const double rest = 1.0 - a;
  return (5.0 - 3.0 * a - std::sqrt(1.0 - 3.0 * rest * rest)) / 6.0;
}

/// The three points around a place along one direction.
struct RomaPoints {
  int first = 0;
  std::array<double, 3> weight{};

  /// `place` in spacings from point 0.
  [[nodiscard]] static RomaPoints around(double place) {
    const double nearest = std::floor(place + 0.5);
    const double off = place - nearest;
    return {static_cast<int>(nearest) - 1, {roma(off + 1.0), roma(off), roma(off - 1.0)}};
  }
};

}  // namespace dust::resolved

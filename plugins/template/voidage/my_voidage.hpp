// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace my_voidage {

/// Side of the cube with the volume of a sphere, over the sphere's radius.
inline const double k_side = std::cbrt(4.0 / 3.0 * 3.14159265358979323846);

/// How a length that begins in cell `first` is shared between it and the next.
struct Shares {
  int first = 0;
  double in_first = 1.0;  ///< [-] the rest lies in the next cell
};

/// Shares of the piece [centre - side / 2, centre + side / 2] on a grid from `origin` with cells
/// of `spacing` [m]; the piece is not longer than a cell.
inline Shares shares(double centre, double side, double origin, double spacing) {
  const double low = (centre - 0.5 * side - origin) / spacing;
  const double first = std::floor(low);
  const double in_first = (first + 1.0 - low) * spacing / side;
  return {static_cast<int>(first), in_first < 1.0 ? in_first : 1.0};
}

}  // namespace my_voidage

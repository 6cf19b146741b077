// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::airborne {

/// The slope of a cell from the steps to both neighbours, after van Leer (J. Comput. Phys. 14
/// (1974) 361): their harmonic mean 2 a b / (a + b), 0 at an extremum. Never more than twice the
/// smaller step, so that values on faces stay between those of the cells;
/// docs/theory/dust.md, eq. (4).
inline double limited_slope(double a, double b) {
  const double product = a * b;
  // Where both have one sign their sum has it, too, and is not zero; elsewhere nothing over one, so
  // that a row of cells is divided without a branch.
  const bool is_same_way = product > 0.0;
  return (is_same_way ? 2.0 * product : 0.0) / (is_same_way ? a + b : 1.0);
}

}  // namespace dust::airborne

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>

#include <cstddef>
#include <span>

namespace dust::model::segregation {

/// Numbers of fine and of all grains in one cell.
struct Cell {
  double fine = 0.0;
  double all = 0.0;
};

/// Lacey's index of mixing, 0 for separate and 1 for randomly mixed:
/// \f$ M = (\sigma_0^2 - \sigma^2) / (\sigma_0^2 - \sigma_r^2) \f$, with the variance of the share
/// of fine grains over the cells, weighted by their numbers, \f$ \sigma^2 = \sum n_c (p_c - p)^2 /
/// N \f$, that of separate grains \f$ \sigma_0^2 = p (1 - p) \f$ and that of a random mixture in K
/// cells \f$ \sigma_r^2 = p (1 - p) (K - 1) / N \f$ (the expectation of the first formula for
/// binomial numbers). Lacey, J. Appl. Chem. 4 (1954) 257, doi:10.1002/jctb.5010040504. It scatters
/// round 1 where grains are mixed. sdk::k_no_value where it has no meaning: one kind alone, or no
/// more grains than cells.
inline double lacey(std::span<const Cell> cells) {
  double fine = 0.0;
  double all = 0.0;
  double filled = 0.0;
  for (const Cell& c : cells) {
    fine += c.fine;
    all += c.all;
    filled += c.all > 0.0 ? 1.0 : 0.0;
  }
  if (!(fine > 0.0) || !(fine < all) || !(all > filled) || !(filled > 1.0)) {
    return sdk::k_no_value;
  }
  const double p = fine / all;
  double variance = 0.0;
  for (const Cell& c : cells) {
    if (!(c.all > 0.0)) continue;
    const double off = c.fine / c.all - p;
    variance += c.all * off * off / all;
  }
  const double separate = p * (1.0 - p);
  const double random = separate * (filled - 1.0) / all;
  return (separate - variance) / (separate - random);
}

}  // namespace dust::model::segregation

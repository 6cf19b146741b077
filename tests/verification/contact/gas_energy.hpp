// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/dem_rig.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace dust::test {

/// Energy [J] of frictionless grains in a periodic cube of edge `edge` [m]: kinetic, and that of
/// the Hertz springs, 8/15 E* sqrt(R*) d^(5/2), E* = `young` [Pa]. Calls look(i, j, overlap) for
/// each pair of ids in the lists.
template <class Look>
double energy_of_gas(particles::Dem& dem, double edge, double young, Look&& look) {
  dem.neighbours();
  const auto rows = dem.rows();
  std::vector<std::size_t> row_of(rows.count);
  double sum = 0.0;
  for (std::size_t n = 0; n < rows.count; ++n) {
    row_of[static_cast<std::size_t>(rows.id[n])] = n;
    const double* v = rows.velocity_of(n);
    sum += 0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / v[3];
  }
  for (const auto& [i, j] : dem.listed_pairs()) {
    const double* a = rows.position_of(row_of[static_cast<std::size_t>(i)]);
    const double* b = rows.position_of(row_of[static_cast<std::size_t>(j)]);
    double square = 0.0;
    for (int d = 0; d < 3; ++d) {
      double x = a[d] - b[d];
      x -= edge * std::round(x / edge);
      square += x * x;
    }
    const double overlap = a[3] + b[3] - std::sqrt(square);
    if (overlap > 0.0) {
      const double radius = a[3] * b[3] / (a[3] + b[3]);
      sum += 8.0 / 15.0 * young * std::sqrt(radius) * std::pow(overlap, 2.5);
    }
    look(i, j, overlap);
  }
  return sum;
}

}  // namespace dust::test

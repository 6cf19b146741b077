// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <vector>

namespace dust::fluid {

/// Below this many numbers a loop stays on one thread: a parallel region costs 1 to 2 us.
inline constexpr long k_serial_below = 16000;

/// Calls `body(j, k)` for all rows of `n0` numbers. The rows are independent, so the result does
/// not depend on how they are shared out.
template <class Body>
void for_rows(int n0, int n1, int n2, const Body& body) {
  const int rows = n1 * n2;
  if (static_cast<long>(rows) * n0 < k_serial_below) {
    for (int r = 0; r < rows; ++r) body(r % n1, r / n1);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<int>(0, rows, std::max(1, rows / 64)),
                    [&](const auto& range) {
                      for (int r = range.begin(); r < range.end(); ++r) body(r % n1, r / n1);
                    });
}

/// Sum over the rows of `body(j, k)`, always added in the order of the rows: the same bits for any
/// number of threads.
template <class Body>
double sum_rows(int n0, int n1, int n2, std::vector<double>& partial, const Body& body) {
  partial.assign(static_cast<std::size_t>(n1) * n2, 0.0);
  for_rows(n0, n1, n2,
           [&](int j, int k) { partial[static_cast<std::size_t>(k) * n1 + j] = body(j, k); });
  double sum = 0.0;
  for (const double p : partial) sum += p;
  return sum;
}

/// Largest `body(j, k)` over the rows.
template <class Body>
double max_rows(int n0, int n1, int n2, std::vector<double>& partial, const Body& body) {
  partial.assign(static_cast<std::size_t>(n1) * n2, 0.0);
  for_rows(n0, n1, n2,
           [&](int j, int k) { partial[static_cast<std::size_t>(k) * n1 + j] = body(j, k); });
  double largest = 0.0;
  for (const double p : partial) largest = std::max(largest, p);
  return largest;
}

}  // namespace dust::fluid

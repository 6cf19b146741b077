// SPDX-License-Identifier: Apache-2.0
#include "my_boundary.hpp"

#include <cmath>
#include <cstdio>

// A quarter of a period after the start the gust is strongest, after three quarters weakest.
int main() {
  const double strongest = my_boundary::strength(0.5, 2.0, 0.125);
  const double weakest = my_boundary::strength(0.5, 2.0, 0.375);
  const bool is_right = std::abs(strongest - 1.5) < 1e-12 && std::abs(weakest - 0.5) < 1e-12;
  if (!is_right) std::printf("strength %g and %g\n", strongest, weakest);
  return is_right ? 0 : 1;
}

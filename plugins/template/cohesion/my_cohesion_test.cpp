// SPDX-License-Identifier: Apache-2.0
#include "my_cohesion.hpp"

#include <cmath>
#include <cstdio>

// Numbers worked out by hand: a test that cannot fail is none.
int main() {
  int failed = 0;
  const auto check = [&](double got, double expected, const char* what) {
    if (std::abs(got - expected) <= 1e-5 * std::abs(expected)) return;
    std::printf("%s: %g instead of %g\n", what, got, expected);
    ++failed;
  };
  check(my_cohesion::attraction(0.05, 1e-6, 1e-3, 1e-7), 3.14159e-4, "2 pi 0.05 J/m2 1 mm");
  check(my_cohesion::attraction(0.05, 1e-6, 1e-3, -0.25e-6), 2.35619e-4, "a quarter of the reach");
  check(my_cohesion::attraction(0.05, 1e-6, 1e-3, -2e-6), 0.0, "beyond the reach");
  // Hertz at the resting overlap: 4/3 E* sqrt(R*) d^1.5 is the attraction.
  const double d = my_cohesion::resting_overlap(0.05, 1e7, 1e-3);
  check(4.0 / 3.0 * 1e7 * std::sqrt(1e-3) * d * std::sqrt(d), 3.14159e-4, "rest");
  return failed == 0 ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
#include "my_turbulence.hpp"

#include <cmath>
#include <cstdio>

// Numbers worked out by hand: a test that cannot fail is none.
int main() {
  int failed = 0;
  const auto check = [&](double got, double expected, const char* what) {
    if (std::abs(got - expected) <= 1e-6 * std::abs(expected)) return;
    std::printf("%s: %g instead of %g\n", what, got, expected);
    ++failed;
  };
  check(my_turbulence::eddy_viscosity(1.2, 1e-3, 1.0, 100.0), 1.2e-4, "far from walls");
  check(my_turbulence::eddy_viscosity(1.2, 1e-3, 1e-3, 100.0), 1.2e-4 * 0.1681, "at a wall");
  check(my_turbulence::eddy_viscosity(1.2, 1e-3, 1.0, 0.0), 0.0, "nothing is sheared");
  return failed == 0 ? 0 : 1;
}

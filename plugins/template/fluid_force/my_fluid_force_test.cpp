// SPDX-License-Identifier: Apache-2.0
#include "my_fluid_force.hpp"

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
  // A grain of 1 mm that lags by 0.2 m/s along x in air that is faster the higher: du/dz = 50 1/s.
  const auto lift = my_fluid_force::force(0.5, 1.2, 1e-3, {0.2, 0, 0}, {0, 50, 0});
  check(lift.z, 0.5 * 1.2 * 5.235988e-10 * 0.2 * 50, "towards the faster air");
  check(lift.x + lift.y, 0, "across the slip only");
  return failed == 0 ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
#include "my_liberation.hpp"

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
  check(my_liberation::released(2e-6, 1e-3, 1e-4, 10.0), 2e-6 * 0.6321205588, "once the energy");
  check(my_liberation::released(2e-6, 1e-9, 1e-4, 10.0), 2e-12, "a little energy");
  check(my_liberation::released(2e-6, 0.0, 1e-4, 10.0), 0.0, "no impact");
  return failed == 0 ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
#include "my_drag.hpp"

#include <cmath>
#include <cstdio>

// Numbers worked out by hand: a test that cannot fail is none.
int main() {
  int failed = 0;
  const auto check = [&](double got, double expected, const char* what) {
    if (std::abs(got - expected) <= 1e-4 * std::abs(expected)) return;
    std::printf("%s: %g instead of %g\n", what, got, expected);
    ++failed;
  };
  check(my_drag::factor(0.0, 1.0, 2.65), 1.0, "Stokes's law for an isolated slow grain");
  check(my_drag::factor(100.0, 1.0, 2.65), 4.54888, "1 + 0.15 * 100^0.687");
  check(my_drag::factor(0.0, 0.5, 2.0), 4.0, "half void, squared");
  return failed == 0 ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
#include "my_motion.hpp"

#include <cmath>
#include <cstdio>

// Full speed at the start, none after a quarter of a stroke, full speed back after half of one.
int main() {
  const bool is_right = my_motion::phase(2.0, 0.0) == 1.0 &&
                        std::abs(my_motion::phase(2.0, 0.125)) < 1e-12 &&
                        std::abs(my_motion::phase(2.0, 0.25) + 1.0) < 1e-12;
  if (!is_right) std::printf("phase %g at the start\n", my_motion::phase(2.0, 0.0));
  return is_right ? 0 : 1;
}

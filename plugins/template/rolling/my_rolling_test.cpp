// SPDX-License-Identifier: Apache-2.0
#include "my_rolling.hpp"

#include <cmath>
#include <cstdio>

// Rolling about y on a plane with normal z, fast: mu_r R* F_n against it. Spinning about the normal
// is not rolling.
int main() {
  my_rolling::Rolling fast{0, 0, 1, 0, 1e6, 0, 0.002, 3.0, 0, 0, 0};
  my_rolling::evaluate(0.5, 1.0, fast);
  my_rolling::Rolling spinning{0, 0, 1, 0, 0, 1e6, 0.002, 3.0, 0, 0, 0};
  my_rolling::evaluate(0.5, 1.0, spinning);
  const bool is_right = std::abs(fast.my + 0.003) < 1e-9 && fast.mx == 0.0 && fast.mz == 0.0 &&
                        spinning.mx == 0.0 && spinning.my == 0.0 && spinning.mz == 0.0;
  if (!is_right) std::printf("couple %g instead of -0.003\n", fast.my);
  return is_right ? 0 : 1;
}

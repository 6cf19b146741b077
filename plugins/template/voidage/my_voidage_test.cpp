// SPDX-License-Identifier: Apache-2.0
#include "my_voidage.hpp"

#include <cmath>
#include <cstdio>

// A piece of 0.4 on cells of 1 from 0: whole in the first cell, then a quarter beyond its end.
int main() {
  const auto whole = my_voidage::shares(0.5, 0.4, 0.0, 1.0);
  const auto cut = my_voidage::shares(0.9, 0.4, 0.0, 1.0);
  const bool is_right = whole.first == 0 && whole.in_first == 1.0 && cut.first == 0 &&
                        std::abs(cut.in_first - 0.75) < 1e-12 &&
                        std::abs(std::pow(my_voidage::k_side, 3) - 4.18879) < 1e-4;
  if (!is_right) std::printf("shares %g and %g\n", whole.in_first, cut.in_first);
  return is_right ? 0 : 1;
}

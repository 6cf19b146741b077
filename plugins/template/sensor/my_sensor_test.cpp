// SPDX-License-Identifier: Apache-2.0
#include "my_sensor.hpp"

#include <cmath>
#include <cstdio>

// 2 kg at (1, 2, 2) m/s: 9 J.
int main() {
  const double energy = my_sensor::kinetic_energy(2.0, 1.0, 2.0, 2.0);
  if (std::abs(energy - 9.0) < 1e-12) return 0;
  std::printf("%g J instead of 9\n", energy);
  return 1;
}

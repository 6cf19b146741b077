// SPDX-License-Identifier: Apache-2.0
#include "my_sensor.hpp"

#include <cmath>
#include <cstdio>

int main() {
  // 2 kg at (1, 2, 2) m/s: 9 J.
  const double energy = my_sensor::kinetic_energy(2.0, 1.0, 2.0, 2.0);
  // 0.02 J/kg is between 10^-2 and 10^-1, the fifth bin from 10^-6 on.
  const std::size_t bin = my_sensor::decade(0.02);
  // 2 x 3 x 4 cells of 1 m: (1.5, 2.5, 3.5) m is in the last one, (9, 0, 0) beyond x in the second.
  const dust::sdk::GridShape grid{{0, 0, 0}, {1, 1, 1}, {2, 3, 4}};
  const std::size_t last = my_sensor::cell({1.5, 2.5, 3.5}, grid);
  const std::size_t beyond = my_sensor::cell({9.0, 0.0, 0.0}, grid);
  if (std::abs(energy - 9.0) < 1e-12 && bin == 4 && last == 23 && beyond == 1) return 0;
  std::printf("%g J instead of 9, bin %zu instead of 4, cells %zu and %zu instead of 23 and 1\n",
              energy, bin, last, beyond);
  return 1;
}

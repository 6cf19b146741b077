// SPDX-License-Identifier: Apache-2.0
#include "my_emitter.hpp"

#include <cmath>
#include <cstdio>

// A sphere of 2 m and 1 kg/m3 weighs 4/3 pi kg; at 1 kg/s the first is half released at 2/3 pi s.
int main() {
  const double mass = my_emitter::grain_mass(2.0, 1.0);
  const double first = my_emitter::time_of(0, mass, 1.0);
  const bool is_right = std::abs(mass - 4.18879) < 1e-5 && std::abs(first - 2.09440) < 1e-5 &&
                        std::abs(my_emitter::time_of(1, mass, 1.0) - first - mass) < 1e-12;
  if (!is_right) std::printf("mass %g, first at %g\n", mass, first);
  return is_right ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
#include "my_contact.hpp"

#include <cmath>
#include <cstdio>

// A head-on collision of unit mass on a unit spring: half a period, and the restitution asked for.
int main() {
  my_contact::Constants k;
  k.stiffness = 1.0;
  k.damping = my_contact::damping(0.5);
  const double step = 1e-4;
  double overlap = 0.0;
  double speed = -1.0;  // of separation
  for (int n = 0; n < 100000; ++n) {
    my_contact::Contact c{};
    c.overlap = overlap;
    c.nx = 1.0;
    c.vx = speed;
    c.mass = 1.0;
    my_contact::evaluate(k, c);
    speed += step * c.fx;
    overlap -= step * speed;
    if (overlap <= 0.0) break;
  }
  // First order in the step: a few steps of 1e-4.
  const bool is_right = std::abs(speed - 0.5) < 1e-3;
  if (!is_right) std::printf("realised restitution %g instead of 0.5\n", speed);
  const bool is_half_swing = std::abs(my_contact::collision_time(1.0, 1.0) - 3.14159265) < 1e-6;
  return is_right && is_half_swing ? 0 : 1;
}

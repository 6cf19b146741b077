// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sphere.hpp>

#include <cstdint>

namespace my_emitter {

/// When grain n (from 0) comes [s]: grains of mass m [kg] at the rate \f$ \dot m \f$ [kg/s],
/// \f$ t_n = (n + 1/2) m / \dot m \f$, so that the mass released is right within half a grain.
inline double time_of(std::int64_t n, double grain_mass, double mass_flow) {
  return (static_cast<double>(n) + 0.5) * grain_mass / mass_flow;
}

/// Mass of one grain [kg].
inline double grain_mass(double diameter, double density) {
  return density * dust::sdk::sphere_volume(diameter);
}

}  // namespace my_emitter

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace my_liberation {

/// Dust [kg] that comes off a load m [kg] when an energy E [J] is dissipated at a grain of mass M
/// [kg], \f$ \Delta m = m \left(1 - e^{-E/(M e)}\right) \f$: the specific energy e [J/kg] shakes
/// off all but a share 1/e of the dust.
/// Source: your own here.
inline double released(double load, double energy, double mass, double specific_energy) {
  return -load * std::expm1(-energy / (mass * specific_energy));
}

}  // namespace my_liberation

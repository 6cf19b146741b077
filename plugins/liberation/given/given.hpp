// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace dust::model::given {

/// Dust [kg] that comes off a load m [kg] when an energy E [J] is dissipated at a grain, where a
/// drop of height H [m] at the gravity g [m/s2] sets free r [kg] per kg of material:
///   dm = min(m, s r E / (g H)),
/// s [-] the share of the class in the dust, `drop` = g H [J/kg]; E / (g H) is the mass that the
/// energy drops by H.
/// docs/theory/dust.md, eq. (11).
inline double released(double load, double share, double emission, double energy, double drop) {
  return std::min(load, share * emission * energy / drop);
}

}  // namespace dust::model::given

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::energy {

/// Dust [kg] that comes off a load m [kg] when an energy E [J] is dissipated at a grain that came
/// with m_0 [kg],
///   dm = m (1 - exp(-E / (m_0 e_b))),
/// e_b [J/kg] the energy that binds the dust: E / e_b of a fresh grain while that is little beside
/// the load, whatever the load; never more than the load; the same in one contact of E as in two of
/// E / 2. After J. E. Hilton and P. W. Cleary's rule that dust follows the dissipated energy, Int.
/// J. Numer. Meth. Fluids 72 (2013) 528, doi:10.1002/fld.3750; docs/theory/dust.md, eq. (8).
inline double released(double load, double fresh_load, double energy, double binding_energy) {
  if (!(load > 0.0) || !(energy > 0.0)) return 0.0;
  return -load * std::expm1(-energy / (fresh_load * binding_energy));
}

/// e_b [J/kg] of a class of diameter d [m] from that of the reference diameter d0,
///   e_b(d) = e_b(d0) (d / d0)^-n; docs/theory/dust.md, eq. (9).
inline double binding_of(double diameter, double reference_binding, double reference_diameter,
                         double exponent) {
  return reference_binding * std::pow(diameter / reference_diameter, -exponent);
}

}  // namespace dust::model::energy

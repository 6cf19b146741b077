// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace my_drag {

/// Drag on one grain relative to Stokes's law,
/// \f$ F(Re, \varepsilon) = (1 + 0.15\,Re^{0.687})\, \varepsilon^{-n} \f$.
/// Re: with the superficial slip [-]; void_fraction in (0, 1]; exponent n [-].
/// Source: Schiller, Naumann, VDI-Z. 77 (1935) 318, times a power of the void fraction.
inline double factor(double reynolds, double void_fraction, double exponent) {
  return (1.0 + 0.15 * std::pow(reynolds, 0.687)) * std::pow(void_fraction, -exponent);
}

}  // namespace my_drag

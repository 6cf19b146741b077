// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::sdk {

/// Health-related shares of airborne dust: the part of the mass of grains of one size that a
/// sampler after the convention takes in.
struct DustFractions {
  double inhalable = 0.0;
  double thoracic = 0.0;
  double respirable = 0.0;
  double pm10 = 0.0;
};

/// The diameter of a sphere of 1000 kg/m3 that settles as fast [m]: d sqrt(rho / 1000). Valid where
/// Stokes' law is (quartz up to about 50 um) and without slip (above about 1 um); within 2 % of the
/// full expressions from 3 to 40 um.
inline double aerodynamic_diameter(double diameter, double density) {
  constexpr double k_unit_density = 1000.0;  // kg/m3
  return diameter * std::sqrt(density / k_unit_density);
}

/// Part of the mass of a size that passes a lognormal cut, 1 - F: `size` and `median` in one unit,
/// geometric deviation 1.5.
inline double passes_cut(double size, double median) {
  constexpr double k_geometric_deviation = 1.5;
  if (!(size > 0.0)) return 1.0;
  return 0.5 *
         std::erfc(std::log(size / median) / (std::log(k_geometric_deviation) * std::sqrt(2.0)));
}

/// The conventions of EN 481:1993 (those of ISO 7708:1995), by aerodynamic diameter D [m]:
///   inhalable  E_I = 0.5 (1 + exp(-0.06 D / um)), for D <= 100 um
///   thoracic   E_T = E_I (1 - F), F lognormal with median 11.64 um and geometric deviation 1.5
///   respirable E_R = E_I (1 - F), F lognormal with median  4.25 um and geometric deviation 1.5
/// and PM10 as inventories of emissions count it: all of D <= 10 um, nothing above (the thoracic
/// convention passes half at the same diameter). Above 100 um, where EN 481 ends, all are 0.
inline DustFractions dust_fractions(double diameter) {
  constexpr double k_micrometre = 1e-6;         // m
  constexpr double k_end_of_convention = 1e-4;  // m
  constexpr double k_thoracic_median = 11.64;   // um
  constexpr double k_respirable_median = 4.25;  // um
  constexpr double k_pm10_cut = 10.0;           // um
  // A cut needs some room for the rounding of a diameter given as 100 um.
  if (!(diameter >= 0.0) || diameter > k_end_of_convention * (1.0 + 1e-9)) return {};
  const double size = diameter / k_micrometre;
  DustFractions shares;
  shares.inhalable = 0.5 * (1.0 + std::exp(-0.06 * size));
  shares.thoracic = shares.inhalable * passes_cut(size, k_thoracic_median);
  shares.respirable = shares.inhalable * passes_cut(size, k_respirable_median);
  shares.pm10 = size <= k_pm10_cut * (1.0 + 1e-9) ? 1.0 : 0.0;
  return shares;
}

}  // namespace dust::sdk

// SPDX-License-Identifier: Apache-2.0
#include "report/facts/dust_fractions.hpp"

#include <cmath>

namespace dust::report {

namespace {

constexpr double k_unit_density = 1000.0;     ///< [kg/m3]
constexpr double k_micrometre = 1e-6;         ///< [m]
constexpr double k_end_of_convention = 1e-4;  ///< [m]
constexpr double k_thoracic_median = 11.64;   ///< [um]
constexpr double k_respirable_median = 4.25;  ///< [um]
constexpr double k_geometric_deviation = 1.5;
constexpr double k_pm10_cut = 10.0;  ///< [um]

/// 1 - F of the lognormal distribution.
double passes(double size, double median) {
  if (!(size > 0.0)) return 1.0;
  return 0.5 *
         std::erfc(std::log(size / median) / (std::log(k_geometric_deviation) * std::sqrt(2.0)));
}

}  // namespace

double aerodynamic_diameter(double diameter, double density) {
  return diameter * std::sqrt(density / k_unit_density);
}

DustFractions dust_fractions(double diameter) {
  // A cut needs some room for the rounding of a diameter given as 100 um.
  if (!(diameter >= 0.0) || diameter > k_end_of_convention * (1.0 + 1e-9)) return {};
  const double size = diameter / k_micrometre;
  DustFractions shares;
  shares.inhalable = 0.5 * (1.0 + std::exp(-0.06 * size));
  shares.thoracic = shares.inhalable * passes(size, k_thoracic_median);
  shares.respirable = shares.inhalable * passes(size, k_respirable_median);
  shares.pm10 = size <= k_pm10_cut * (1.0 + 1e-9) ? 1.0 : 0.0;
  return shares;
}

}  // namespace dust::report

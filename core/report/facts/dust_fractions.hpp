// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::report {

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
[[nodiscard]] double aerodynamic_diameter(double diameter, double density);

/// The conventions of EN 481:1993 (those of ISO 7708:1995), by aerodynamic diameter D [m]:
///   inhalable  E_I = 0.5 (1 + exp(-0.06 D / um)), for D <= 100 um
///   thoracic   E_T = E_I (1 - F), F lognormal with median 11.64 um and geometric deviation 1.5
///   respirable E_R = E_I (1 - F), F lognormal with median  4.25 um and geometric deviation 1.5
/// and PM10 as inventories of emissions count it: all of D <= 10 um, nothing above (the thoracic
/// convention passes half at the same diameter). Above 100 um, where EN 481 ends, all are 0.
[[nodiscard]] DustFractions dust_fractions(double aerodynamic_diameter);

}  // namespace dust::report

// SPDX-License-Identifier: Apache-2.0
#include "airborne/dust_class.hpp"

#include <cmath>
#include <numbers>

namespace dust::airborne {
namespace {

constexpr double k_mean_free_path = 66e-9;     ///< [m] of air at room conditions
constexpr double k_densest_gas = 100.0;        ///< [kg/m3] heavier ones are liquids
constexpr double k_boltzmann = 1.380649e-23;   ///< [J/K]
constexpr double k_room_temperature = 293.15;  ///< [K]
constexpr int k_iterations = 60;

}  // namespace

double slip_correction(double diameter, const Gas& gas) {
  if (gas.density > k_densest_gas) return 1.0;
  const double knudsen = 2.0 * k_mean_free_path / diameter;
  return 1.0 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen));
}

double terminal_velocity(double diameter, double density, double weight, const Gas& gas) {
  const double stokes = density * diameter * diameter * weight / (18.0 * gas.viscosity) *
                        slip_correction(diameter, gas);
  // v (1 + 0.15 Re^0.687) = v_stokes: the left side grows with v, so that halving finds it.
  double low = 0.0;
  double high = stokes;
  for (int n = 0; n < k_iterations; ++n) {
    const double v = 0.5 * (low + high);
    const double reynolds = gas.density * v * diameter / gas.viscosity;
    (v * (1.0 + 0.15 * std::pow(reynolds, 0.687)) < stokes ? low : high) = v;
  }
  return 0.5 * (low + high);
}

double brownian_diffusivity(double diameter, const Gas& gas) {
  return k_boltzmann * k_room_temperature * slip_correction(diameter, gas) /
         (3.0 * std::numbers::pi * gas.viscosity * diameter);
}

DustClass make_class(double diameter, double density, sdk::Vec3 gravity, const Gas& gas) {
  DustClass made;
  made.diameter = diameter;
  made.diffusivity = brownian_diffusivity(diameter, gas);
  made.response_time =
      density * diameter * diameter * slip_correction(diameter, gas) / (18.0 * gas.viscosity);
  const double g = norm(gravity);
  if (!(g > 0.0)) return made;
  // Dust lighter than the gas rises.
  const double weight = (1.0 - gas.density / density) * g;
  const double speed = terminal_velocity(diameter, density, std::abs(weight), gas);
  made.drift = (weight < 0.0 ? -speed : speed) / g * gravity;
  return made;
}

}  // namespace dust::airborne

// SPDX-License-Identifier: Apache-2.0
#include "airborne/near_wall.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::airborne {
namespace {

/// [-] The integral of the resistance of the layer at the wall.
double layer_integral(const DustClass& dust, double friction_velocity, double viscosity) {
  constexpr double k_edge = 4.3;  // y+ where the innermost of three layers ends
  const double schmidt = viscosity / dust.diffusivity;
  const double s = 10.92 / std::cbrt(schmidt);
  const double radius = std::min(k_edge, 0.5 * dust.diameter * friction_velocity / viscosity);
  const auto part = [&](double y, double cubic) {
    return 0.5 * std::log(std::pow(s + y, 3) / (1.0 / schmidt + cubic)) +
           std::numbers::sqrt3 * std::atan((2.0 * y - s) / (std::numbers::sqrt3 * s));
  };
  const double outer = part(k_edge, 0.0609);
  const double inner = part(radius, 7.669e-4 * radius * radius * radius);
  return 3.64 * std::pow(schmidt, 2.0 / 3.0) * (outer - inner) + 39.0;
}

}  // namespace

double friction_velocity(double speed, double distance, double viscosity) {
  constexpr double k_edge = 11.81;  // y+
  constexpr double k_factor = 8.3;
  if (speed * distance <= k_edge * k_edge * viscosity) {
    return std::sqrt(viscosity * speed / distance);
  }
  return std::pow(speed / k_factor, 7.0 / 8.0) * std::pow(viscosity / distance, 1.0 / 8.0);
}

double deposition_velocity(const DustClass& dust, double settling, double friction_velocity,
                           double viscosity) {
  if (!(friction_velocity > 0.0)) return std::max(0.0, settling);
  const double resistance = layer_integral(dust, friction_velocity, viscosity) / friction_velocity;
  const double x = settling * resistance;
  // The limit of walls that stand.
  if (std::abs(x) < 1e-9) return 1.0 / resistance;
  return settling / -std::expm1(-x);
}

}  // namespace dust::airborne

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>

#include <cstddef>

namespace dust::model::kinetic_energy {

/// Weighted sums over grains, from which all figures follow.
struct Sums {
  double translation = 0.0;        ///< [J] \f$ \sum w m v^2 / 2 \f$
  double rotation = 0.0;           ///< [J] \f$ \sum w m R^2 \omega^2 / 5 \f$ (I = 2/5 m R^2)
  double number = 0.0;             ///< \f$ \sum w \f$
  double mass = 0.0;               ///< [kg]
  double momentum[3] = {0, 0, 0};  ///< [kg m/s]

  /// Those of one grain of statistical weight `weight`, with velocity `v` [m/s] and angular
  /// velocity `w` [rad/s].
  static Sums of_grain(double weight, double grain_mass, double radius, const double (&v)[3],
                       const double (&w)[3]) {
    const double m = weight * grain_mass;
    return {.translation = 0.5 * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]),
            .rotation = 0.2 * m * radius * radius * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]),
            .number = weight,
            .mass = m,
            .momentum = {m * v[0], m * v[1], m * v[2]}};
  }
  Sums& operator+=(const Sums& other) {
    translation += other.translation;
    rotation += other.rotation;
    number += other.number;
    mass += other.mass;
    for (std::size_t d = 0; d < 3; ++d) momentum[d] += other.momentum[d];
    return *this;
  }
  /// [J] sdk::k_no_value without grains, as the temperature.
  [[nodiscard]] double mean_per_grain() const {
    return number > 0.0 ? (translation + rotation) / number : sdk::k_no_value;
  }
  /// Granular temperature [m2/s2]: \f$ T = \langle (\mathbf v - \bar{\mathbf v})^2 \rangle / 3 \f$,
  /// means weighted by mass (Haff, J. Fluid Mech. 134 (1983) 401).
  [[nodiscard]] double temperature() const {
    if (!(mass > 0.0)) return sdk::k_no_value;
    double drift2 = 0.0;
    for (const double p : momentum) drift2 += p * p;
    const double t = (2.0 * translation - drift2 / mass) / (3.0 * mass);
    return t > 0.0 ? t : 0.0;  // rounding of a difference
  }
};

}  // namespace dust::model::kinetic_energy

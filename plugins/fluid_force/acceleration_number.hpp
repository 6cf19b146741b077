// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cmath>

namespace dust::model {

/// Acceleration number [-] of a grain of `diameter` [m] whose slip w [m/s] changes at the rate w'
/// [m/s2]: \f$ A_c = \frac{|w|^2}{D\, |dw/dt|} \f$; 0 where the motion has just begun, infinite
/// where it is steady.
/// Source: Odar, Hamilton, J. Fluid Mech. 18 (1964) 302, doi:10.1017/S0022112064000210.
inline double acceleration_number(double diameter, sdk::Vec3 slip, sdk::Vec3 rate) {
  const double square = dot(slip, slip);
  return square > 0.0 ? square / (diameter * norm(rate)) : 0.0;
}

/// Virtual mass over that of a motion that has just begun, [-] from 1 to 2.1:
/// \f$ \frac{C_A(A_c)}{C_A(0)} = 2.1 - \frac{0.132}{A_c^2 + 0.12} \f$, C_A(0) = 0.5.
/// Measured on spheres that swing in oil, Re below 62. Source: as above.
inline double virtual_mass_factor(double acceleration_number) {
  return 2.1 - 0.132 / (acceleration_number * acceleration_number + 0.12);
}

/// History force over that of a motion that has just begun, [-] from 1 to 0.48:
/// \f$ \frac{C_H(A_c)}{C_H(0)} = 0.48 + \frac{0.52}{(1 + A_c)^3} \f$, C_H(0) = 6 where Basset's
/// force is \f$ C_H \frac{D^2}{4} \sqrt{\pi \rho_f \mu} \int \dots \f$. Range and source: as above.
inline double history_factor(double acceleration_number) {
  const double one_more = 1.0 + acceleration_number;
  return 0.48 + 0.52 / (one_more * one_more * one_more);
}

/// The slip of one grain a refresh ago, to know its rate by; on a row of numbers that the core
/// keeps and saves, zero for a new grain.
class LastSlip {
 public:
  static constexpr int k_numbers = 5;
  explicit LastSlip(double* row) : row_(row) {}

  /// The acceleration number of the interval that has just ended, 0 for a grain that is new; takes
  /// note of the slip now and of the `interval` [s] to come.
  double note(double diameter, sdk::Vec3 slip, double interval) {
    const bool is_new = row_[0] == 0.0;
    const sdk::Vec3 last{row_[1], row_[2], row_[3]};
    const double number =
        is_new ? 0.0 : acceleration_number(diameter, slip, (1.0 / row_[4]) * (slip - last));
    row_[0] = 1.0;
    for (int d = 0; d < 3; ++d) row_[1 + d] = slip[d];
    row_[4] = interval;
    return number;
  }

 private:
  double* row_;
};

}  // namespace dust::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

namespace dust::airborne {

/// Stokes number tau |grad u| up to which the drift by inertia is that of a short response time;
/// from there on it is that of dust of this Stokes number (docs/theory/dust.md, section 1).
inline constexpr double k_largest_stokes_number = 0.2;

/// The gas that dust hangs in.
struct Gas {
  double density = 0.0;    ///< [kg/m3]
  double viscosity = 0.0;  ///< [Pa s]
};

/// Slip of a small sphere in a gas (Cunningham; fit of Davies, Proc. Phys. Soc. 57 (1945) 259,
/// doi:10.1088/0959-5309/57/4/301): C_c = 1 + Kn (1.257 + 0.4 exp(-1.1 / Kn)), Kn = 2 lambda / d,
/// lambda = 66 nm as in air at room conditions. None in a liquid. `diameter` [m]; returns [-].
[[nodiscard]] double slip_correction(double diameter, const Gas& gas);

/// Terminal velocity [m/s] of a sphere that falls in a gas at rest with the drag of Schiller and
/// Naumann (1935), C_d = 24 / Re (1 + 0.15 Re^0.687), and slip; `weight` [m/s2] is gravity less
/// buoyancy per mass; docs/theory/dust.md, eq. (2). Valid for Re < 1000, so for any dust.
[[nodiscard]] double terminal_velocity(double diameter, double density, double weight,
                                       const Gas& gas);

/// Diffusivity of Brownian motion [m2/s]: k T C_c / (3 pi mu d), at 293 K;
/// docs/theory/dust.md, eq. (3).
[[nodiscard]] double brownian_diffusivity(double diameter, const Gas& gas);

/// A size class of airborne dust: what moves it besides the gas.
struct DustClass {
  double diameter = 0.0;       ///< [m]
  sdk::Vec3 drift;             ///< [m/s] of settling
  double diffusivity = 0.0;    ///< [m2/s] Brownian
  double response_time = 0.0;  ///< [s] rho_p d^2 C_c / (18 mu), after Stokes
  /// [s] Of the drift by inertia: settling velocity over gravity; 0: dust turns with the gas.
  double inertia_time = 0.0;
};

/// `gravity` [m/s2], `density` [kg/m3] of the dust itself.
[[nodiscard]] DustClass make_class(double diameter, double density, sdk::Vec3 gravity,
                                   const Gas& gas);

}  // namespace dust::airborne

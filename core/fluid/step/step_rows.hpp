// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/face_properties.hpp"

#include <cstddef>
#include <numbers>

/// Loops of the fluid step over rows of faces. `inertia` of a uniform fluid is its density; the
/// same arithmetic with one number per face elsewhere.
namespace dust::fluid {

// Two-stage Runge-Kutta pair of Ascher, Ruuth and Spiteri (1997), ARS(2,2,2),
// 10.1016/S0168-9274(97)00056-1: second order, the implicit part L-stable and stiffly accurate.
inline constexpr double k_gamma = 1.0 - 0.5 * std::numbers::sqrt2;
inline constexpr double k_delta = 1.0 - 0.5 / k_gamma;

/// A row of faces and the step that is made there.
struct StepRow {
  int n = 0;             ///< faces
  std::ptrdiff_t s = 0;  ///< face i lies between the cells i - s and i
  double step = 0.0;     ///< [s]
  RowProperty inertia;
};
/// A pressure along a row: its gradient is inverse_h (p[i] - p[i - s]).
struct PressureRow {
  const double* p = nullptr;
  double inverse_h = 0.0;  ///< [1/m]
};
/// What drives a row.
struct DrivingRow {
  PressureRow pressure;
  const double* source = nullptr;  ///< [N/m3]
};
/// The open area and the void fractions that give the fluid's part of each face.
struct OpenRow {
  const double* area = nullptr;
  const double* eps = nullptr;
};
/// Coefficients of the pressure equation, 0 where no pressure acts, and of the drag.
struct CoefficientRow {
  const double* k = nullptr;
  const double* drag = nullptr;
};
/// Velocities and right side of the first stage, as the second needs them.
struct FirstStageRow {
  const double* u = nullptr;
  const double* first = nullptr;
  const double* right = nullptr;
};

/// right = u + gamma step ((source - grad p) / inertia - convection)
void first_stage_row(StepRow row, DrivingRow driving, const double* u, const double* convection,
                     double* right);
/// In: `convection` of the first stage; out: everything of the second right side but its own
/// convection.
void between_stages_row(StepRow row, DrivingRow driving, FirstStageRow stage, double* convection);
void second_stage_row(int n, double step, const double* sum, const double* convection,
                      double* right);
/// Coefficients of the pressure equation, over the fluid's own density; `inverse_h2` in 1/m2.
void coefficient_row(StepRow row, double inverse_h2, OpenRow open, const double* drag, double* k);
/// Velocity [m/s] that drag acted on, in excess of the stages', while the pressure `phi` acted over
/// the step: of its force the share 1 - response(z) went into the drag.
void pressure_drag_row(StepRow row, PressureRow phi, CoefficientRow coefficients, double share,
                       double* mean);
void flux_difference_row(int n, std::ptrdiff_t s, double inverse_h, OpenRow open, const double* u,
                         double* sum);
void correct_row(StepRow row, PressureRow phi, CoefficientRow coefficients, double* u);

}  // namespace dust::fluid

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

/// right = u + gamma step ((source - grad p) / inertia - convection)
void first_stage_row(int n, std::ptrdiff_t s, double step, RowProperty inertia, double inverse_h,
                     const double* u, const double* convection, const double* p,
                     const double* source, double* right);
/// In: `convection` of the first stage; out: everything of the second right side but its own
/// convection.
void between_stages_row(int n, std::ptrdiff_t s, double step, RowProperty inertia, double inverse_h,
                        const double* u, const double* first, const double* right, const double* p,
                        const double* source, double* convection);
void second_stage_row(int n, double step, const double* sum, const double* convection,
                      double* right);
/// Coefficients of the pressure equation, over the fluid's own density.
void coefficient_row(int n, std::ptrdiff_t s, double step, RowProperty inertia, double inverse_h2,
                     const double* area, const double* eps, const double* drag, double* k);
/// Velocity [m/s] that drag acted on, in excess of the stages', while the pressure `phi` acted over
/// `step`: of its force the share 1 - response(z) went into the drag.
void pressure_drag_row(int n, std::ptrdiff_t s, double step, RowProperty inertia, double inverse_h,
                       double share, const double* k, const double* drag, const double* phi,
                       double* mean);
void flux_difference_row(int n, std::ptrdiff_t s, double inverse_h, const double* area,
                         const double* eps, const double* u, double* sum);
void correct_row(int n, std::ptrdiff_t s, double step, RowProperty inertia, double inverse_h,
                 const double* k, const double* drag, const double* phi, double* u);

}  // namespace dust::fluid

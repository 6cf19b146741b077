// SPDX-License-Identifier: Apache-2.0
#include "fluid/step/step_rows.hpp"

#include "dust/sdk/plugin.hpp"

#include <cmath>

namespace dust::fluid {
namespace {

/// [m/s] Far ahead of a starting flow speeds fall off to numbers that processors handle 100 times
/// slower; below this they are zero, far under the round-off of anything that is measured.
constexpr double k_nothing = 1e-60;

/// A factor / inertia along a row: one number, or one per face.
struct One {
  double value;
  __attribute__((always_inline)) double operator[](int) const { return value; }
};
struct Each {
  const double* inverse;
  double factor;
  __attribute__((always_inline)) double operator[](int i) const { return factor * inverse[i]; }
};

/// How much of a pressure force over `step` arrives as velocity when drag of rate z / step acts:
/// (1 - R(-z)) / z, R the stability function of the pair; docs/theory/fluid.md, eq. (7).
inline __attribute__((always_inline)) double response(double z) {
  const double d = 1.0 + k_gamma * z;
  return (1.0 + k_gamma * k_gamma * z) / (d * d);
}

template <class Inverse>
inline __attribute__((always_inline)) void first_stage(const StepRow& row, Inverse inverse_density,
                                                       const DrivingRow& driving, const double* u,
                                                       const double* convection, double* right) {
  const std::ptrdiff_t s = row.s;
  const double step = row.step;
  const auto [p, inverse_h] = driving.pressure;
  const double* source = driving.source;
#pragma GCC ivdep
  for (int i = 0; i < row.n; ++i) {
    const double force = inverse_density[i] * (source[i] - inverse_h * (p[i] - p[i - s]));
    right[i] = u[i] + k_gamma * step * (force - convection[i]);
  }
}
DUST_KERNEL void first_stage_one(StepRow row, DrivingRow driving, const double* u,
                                 const double* convection, double* right) {
  first_stage(row, One{1.0 / row.inertia.one}, driving, u, convection, right);
}
DUST_KERNEL void first_stage_each(StepRow row, DrivingRow driving, const double* u,
                                  const double* convection, double* right) {
  first_stage(row, Each{row.inertia.each, 1.0}, driving, u, convection, right);
}

template <class Inverse>
inline __attribute__((always_inline)) void between_stages(const StepRow& row,
                                                          Inverse inverse_density,
                                                          const DrivingRow& driving,
                                                          const FirstStageRow& stage,
                                                          double* convection) {
  constexpr double k_rest = (1.0 - k_gamma) / k_gamma;
  const std::ptrdiff_t s = row.s;
  const double step = row.step;
  const auto [p, inverse_h] = driving.pressure;
  const double* source = driving.source;
  const auto [u, first, right] = stage;
#pragma GCC ivdep
  for (int i = 0; i < row.n; ++i) {
    const double force = inverse_density[i] * (source[i] - inverse_h * (p[i] - p[i - s]));
    convection[i] =
        u[i] - step * k_delta * convection[i] + k_rest * (first[i] - right[i]) + step * force;
  }
}
DUST_KERNEL void between_stages_one(StepRow row, DrivingRow driving, FirstStageRow stage,
                                    double* convection) {
  between_stages(row, One{1.0 / row.inertia.one}, driving, stage, convection);
}
DUST_KERNEL void between_stages_each(StepRow row, DrivingRow driving, FirstStageRow stage,
                                     double* convection) {
  between_stages(row, Each{row.inertia.each, 1.0}, driving, stage, convection);
}

DUST_KERNEL void second_stage(int n, double step, const double* sum, const double* convection,
                              double* right) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) right[i] = sum[i] - step * (1.0 - k_delta) * convection[i];
}

DUST_KERNEL void coefficient_one(StepRow row, double inverse_h2, OpenRow open, const double* drag,
                                 double* k) {
  const std::ptrdiff_t s = row.s;
  const double step_over_density = row.step / row.inertia.one;
  const auto [area, eps] = open;
#pragma GCC ivdep
  for (int i = 0; i < row.n; ++i) {
    const double face = area[i] * 0.5 * (eps[i] + eps[i - s]);
    k[i] = face * inverse_h2 * response(step_over_density * drag[i]);
  }
}
DUST_KERNEL void coefficient_each(StepRow row, double inverse_h2, OpenRow open, const double* drag,
                                  double* k) {
  const std::ptrdiff_t s = row.s;
  const double step = row.step;
  const auto [density, inverse] = row.inertia;
  const auto [area, eps] = open;
#pragma GCC ivdep
  for (int i = 0; i < row.n; ++i) {
    const double face = area[i] * 0.5 * (eps[i] + eps[i - s]) * density * inverse[i];
    k[i] = face * inverse_h2 * response(step * inverse[i] * drag[i]);
  }
}

template <class Inverse>
inline __attribute__((always_inline)) void pressure_drag(const StepRow& row,
                                                         Inverse step_over_density,
                                                         const PressureRow& pressure,
                                                         const CoefficientRow& coefficients,
                                                         double share, double* mean) {
  const std::ptrdiff_t s = row.s;
  const auto [phi, inverse_h] = pressure;
  const auto [k, drag] = coefficients;
#pragma GCC ivdep
  for (int i = 0; i < row.n; ++i) {
    const double z = step_over_density[i] * drag[i];
    const double d = 1.0 + k_gamma * z;
    const double rest = k_gamma * (2.0 - k_gamma + k_gamma * z) / (d * d);  // (1 - response) / z
    const double change = step_over_density[i] * rest * inverse_h * (phi[i] - phi[i - s]);
    mean[i] -= k[i] > 0.0 ? share * change : 0.0;
  }
}
DUST_KERNEL void pressure_drag_one(StepRow row, PressureRow phi, CoefficientRow coefficients,
                                   double share, double* mean) {
  pressure_drag(row, One{row.step / row.inertia.one}, phi, coefficients, share, mean);
}
DUST_KERNEL void pressure_drag_each(StepRow row, PressureRow phi, CoefficientRow coefficients,
                                    double share, double* mean) {
  pressure_drag(row, Each{row.inertia.each, row.step}, phi, coefficients, share, mean);
}

DUST_KERNEL void flux_difference(int n, std::ptrdiff_t s, double inverse_h, OpenRow open,
                                 const double* u, double* sum) {
  const auto [area, eps] = open;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double low = area[i] * 0.5 * (eps[i] + eps[i - s]) * u[i];
    const double high = area[i + s] * 0.5 * (eps[i] + eps[i + s]) * u[i + s];
    sum[i] += inverse_h * (high - low);
  }
}

template <class Inverse>
inline __attribute__((always_inline)) void correct(const StepRow& row, Inverse step_over_density,
                                                   const PressureRow& pressure,
                                                   const CoefficientRow& coefficients, double* u) {
  const std::ptrdiff_t s = row.s;
  const auto [phi, inverse_h] = pressure;
  const auto [k, drag] = coefficients;
#pragma GCC ivdep
  for (int i = 0; i < row.n; ++i) {
    const double change = step_over_density[i] * response(step_over_density[i] * drag[i]) *
                          inverse_h * (phi[i] - phi[i - s]);
    const double next = u[i] - (k[i] > 0.0 ? change : 0.0);
    u[i] = std::abs(next) < k_nothing ? 0.0 : next;
  }
}
DUST_KERNEL void correct_one(StepRow row, PressureRow phi, CoefficientRow coefficients, double* u) {
  correct(row, One{row.step / row.inertia.one}, phi, coefficients, u);
}
DUST_KERNEL void correct_each(StepRow row, PressureRow phi, CoefficientRow coefficients,
                              double* u) {
  correct(row, Each{row.inertia.each, row.step}, phi, coefficients, u);
}

}  // namespace

void first_stage_row(StepRow row, DrivingRow driving, const double* u, const double* convection,
                     double* right) {
  (row.inertia.each == nullptr ? first_stage_one : first_stage_each)(row, driving, u, convection,
                                                                     right);
}

void between_stages_row(StepRow row, DrivingRow driving, FirstStageRow stage, double* convection) {
  (row.inertia.each == nullptr ? between_stages_one : between_stages_each)(row, driving, stage,
                                                                           convection);
}

void second_stage_row(int n, double step, const double* sum, const double* convection,
                      double* right) {
  second_stage(n, step, sum, convection, right);
}

void coefficient_row(StepRow row, double inverse_h2, OpenRow open, const double* drag, double* k) {
  (row.inertia.each == nullptr ? coefficient_one : coefficient_each)(row, inverse_h2, open, drag,
                                                                     k);
}

void pressure_drag_row(StepRow row, PressureRow phi, CoefficientRow coefficients, double share,
                       double* mean) {
  (row.inertia.each == nullptr ? pressure_drag_one : pressure_drag_each)(row, phi, coefficients,
                                                                         share, mean);
}

void flux_difference_row(int n, std::ptrdiff_t s, double inverse_h, OpenRow open, const double* u,
                         double* sum) {
  flux_difference(n, s, inverse_h, open, u, sum);
}

void correct_row(StepRow row, PressureRow phi, CoefficientRow coefficients, double* u) {
  (row.inertia.each == nullptr ? correct_one : correct_each)(row, phi, coefficients, u);
}

}  // namespace dust::fluid

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
inline __attribute__((always_inline)) void first_stage(int n, std::ptrdiff_t s, double step,
                                                       Inverse inverse_density, double inverse_h,
                                                       const double* u, const double* convection,
                                                       const double* p, const double* source,
                                                       double* right) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double force = inverse_density[i] * (source[i] - inverse_h * (p[i] - p[i - s]));
    right[i] = u[i] + k_gamma * step * (force - convection[i]);
  }
}
DUST_KERNEL void first_stage_one(int n, std::ptrdiff_t s, double step, double inverse,
                                 double inverse_h, const double* u, const double* convection,
                                 const double* p, const double* source, double* right) {
  first_stage(n, s, step, One{inverse}, inverse_h, u, convection, p, source, right);
}
DUST_KERNEL void first_stage_each(int n, std::ptrdiff_t s, double step, const double* inverse,
                                  double inverse_h, const double* u, const double* convection,
                                  const double* p, const double* source, double* right) {
  first_stage(n, s, step, Each{inverse, 1.0}, inverse_h, u, convection, p, source, right);
}

template <class Inverse>
inline __attribute__((always_inline)) void between_stages(int n, std::ptrdiff_t s, double step,
                                                          Inverse inverse_density, double inverse_h,
                                                          const double* u, const double* first,
                                                          const double* right, const double* p,
                                                          const double* source,
                                                          double* convection) {
  constexpr double k_rest = (1.0 - k_gamma) / k_gamma;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double force = inverse_density[i] * (source[i] - inverse_h * (p[i] - p[i - s]));
    convection[i] =
        u[i] - step * k_delta * convection[i] + k_rest * (first[i] - right[i]) + step * force;
  }
}
DUST_KERNEL void between_stages_one(int n, std::ptrdiff_t s, double step, double inverse,
                                    double inverse_h, const double* u, const double* first,
                                    const double* right, const double* p, const double* source,
                                    double* convection) {
  between_stages(n, s, step, One{inverse}, inverse_h, u, first, right, p, source, convection);
}
DUST_KERNEL void between_stages_each(int n, std::ptrdiff_t s, double step, const double* inverse,
                                     double inverse_h, const double* u, const double* first,
                                     const double* right, const double* p, const double* source,
                                     double* convection) {
  between_stages(n, s, step, Each{inverse, 1.0}, inverse_h, u, first, right, p, source, convection);
}

DUST_KERNEL void second_stage(int n, double step, const double* sum, const double* convection,
                              double* right) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) right[i] = sum[i] - step * (1.0 - k_delta) * convection[i];
}

DUST_KERNEL void coefficient_one(int n, std::ptrdiff_t s, double step_over_density,
                                 double inverse_h2, const double* area, const double* eps,
                                 const double* drag, double* k) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double face = area[i] * 0.5 * (eps[i] + eps[i - s]);
    k[i] = face * inverse_h2 * response(step_over_density * drag[i]);
  }
}
DUST_KERNEL void coefficient_each(int n, std::ptrdiff_t s, double step, const double* inverse,
                                  double density, double inverse_h2, const double* area,
                                  const double* eps, const double* drag, double* k) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double face = area[i] * 0.5 * (eps[i] + eps[i - s]) * density * inverse[i];
    k[i] = face * inverse_h2 * response(step * inverse[i] * drag[i]);
  }
}

template <class Inverse>
inline __attribute__((always_inline)) void pressure_drag(int n, std::ptrdiff_t s,
                                                         Inverse step_over_density,
                                                         double inverse_h, double share,
                                                         const double* k, const double* drag,
                                                         const double* phi, double* mean) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double z = step_over_density[i] * drag[i];
    const double d = 1.0 + k_gamma * z;
    const double rest = k_gamma * (2.0 - k_gamma + k_gamma * z) / (d * d);  // (1 - response) / z
    const double change = step_over_density[i] * rest * inverse_h * (phi[i] - phi[i - s]);
    mean[i] -= k[i] > 0.0 ? share * change : 0.0;
  }
}
DUST_KERNEL void pressure_drag_one(int n, std::ptrdiff_t s, double step_over_density,
                                   double inverse_h, double share, const double* k,
                                   const double* drag, const double* phi, double* mean) {
  pressure_drag(n, s, One{step_over_density}, inverse_h, share, k, drag, phi, mean);
}
DUST_KERNEL void pressure_drag_each(int n, std::ptrdiff_t s, double step, const double* inverse,
                                    double inverse_h, double share, const double* k,
                                    const double* drag, const double* phi, double* mean) {
  pressure_drag(n, s, Each{inverse, step}, inverse_h, share, k, drag, phi, mean);
}

DUST_KERNEL void flux_difference(int n, std::ptrdiff_t s, double inverse_h, const double* area,
                                 const double* eps, const double* u, double* sum) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double low = area[i] * 0.5 * (eps[i] + eps[i - s]) * u[i];
    const double high = area[i + s] * 0.5 * (eps[i] + eps[i + s]) * u[i + s];
    sum[i] += inverse_h * (high - low);
  }
}

template <class Inverse>
inline __attribute__((always_inline)) void correct(int n, std::ptrdiff_t s,
                                                   Inverse step_over_density, double inverse_h,
                                                   const double* k, const double* drag,
                                                   const double* phi, double* u) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double change = step_over_density[i] * response(step_over_density[i] * drag[i]) *
                          inverse_h * (phi[i] - phi[i - s]);
    const double next = u[i] - (k[i] > 0.0 ? change : 0.0);
    u[i] = std::abs(next) < k_nothing ? 0.0 : next;
  }
}
DUST_KERNEL void correct_one(int n, std::ptrdiff_t s, double step_over_density, double inverse_h,
                             const double* k, const double* drag, const double* phi, double* u) {
  correct(n, s, One{step_over_density}, inverse_h, k, drag, phi, u);
}
DUST_KERNEL void correct_each(int n, std::ptrdiff_t s, double step, const double* inverse,
                              double inverse_h, const double* k, const double* drag,
                              const double* phi, double* u) {
  correct(n, s, Each{inverse, step}, inverse_h, k, drag, phi, u);
}

}  // namespace

void first_stage_row(int n, std::ptrdiff_t s, double step, RowProperty inertia, double inverse_h,
                     const double* u, const double* convection, const double* p,
                     const double* source, double* right) {
  if (inertia.each == nullptr) {
    first_stage_one(n, s, step, 1.0 / inertia.one, inverse_h, u, convection, p, source, right);
  } else {
    first_stage_each(n, s, step, inertia.each, inverse_h, u, convection, p, source, right);
  }
}

void between_stages_row(int n, std::ptrdiff_t s, double step, RowProperty inertia, double inverse_h,
                        const double* u, const double* first, const double* right, const double* p,
                        const double* source, double* convection) {
  if (inertia.each == nullptr) {
    between_stages_one(n, s, step, 1.0 / inertia.one, inverse_h, u, first, right, p, source,
                       convection);
  } else {
    between_stages_each(n, s, step, inertia.each, inverse_h, u, first, right, p, source,
                        convection);
  }
}

void second_stage_row(int n, double step, const double* sum, const double* convection,
                      double* right) {
  second_stage(n, step, sum, convection, right);
}

void coefficient_row(int n, std::ptrdiff_t s, double step, RowProperty inertia, double inverse_h2,
                     const double* area, const double* eps, const double* drag, double* k) {
  if (inertia.each == nullptr) {
    coefficient_one(n, s, step / inertia.one, inverse_h2, area, eps, drag, k);
  } else {
    coefficient_each(n, s, step, inertia.each, inertia.one, inverse_h2, area, eps, drag, k);
  }
}

void pressure_drag_row(int n, std::ptrdiff_t s, double step, RowProperty inertia, double inverse_h,
                       double share, const double* k, const double* drag, const double* phi,
                       double* mean) {
  if (inertia.each == nullptr) {
    pressure_drag_one(n, s, step / inertia.one, inverse_h, share, k, drag, phi, mean);
  } else {
    pressure_drag_each(n, s, step, inertia.each, inverse_h, share, k, drag, phi, mean);
  }
}

void flux_difference_row(int n, std::ptrdiff_t s, double inverse_h, const double* area,
                         const double* eps, const double* u, double* sum) {
  flux_difference(n, s, inverse_h, area, eps, u, sum);
}

void correct_row(int n, std::ptrdiff_t s, double step, RowProperty inertia, double inverse_h,
                 const double* k, const double* drag, const double* phi, double* u) {
  if (inertia.each == nullptr) {
    correct_one(n, s, step / inertia.one, inverse_h, k, drag, phi, u);
  } else {
    correct_each(n, s, step, inertia.each, inverse_h, k, drag, phi, u);
  }
}

}  // namespace dust::fluid

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/plugin.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/one_colour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

/// Loops of the momentum equation over rows of faces: the inside of momentum.cpp, which alone
/// includes this. Internal linkage, so that each kernel's versions stay next to its calls. Pointers
/// and numbers one by one: gathered in structs GCC 12 leaves parts of the loops scalar.
// NOLINTBEGIN(misc-definitions-in-headers)
namespace dust::fluid {
namespace {

/// Value between cells with upstream neighbours: `up`, `at`, and `down` behind the face. Two slopes
/// are blended (weights 1/3 upwind, 2/3 central in smooth flow: third order; the smoother one next
/// to a jump), after Jiang and Shu (1996) 10.1006/jcph.1996.0130 with the global smoothness
/// indicator of Yamaleev, Carpenter (2009) 10.1016/j.jcp.2009.01.011, docs/theory/fluid.md, eq. (4)
inline __attribute__((always_inline)) double face_value(double up, double at, double down,
                                                        double smoothness) {
  const double behind = at - up;
  const double ahead = down - at;
  const double b0 = ahead * ahead + smoothness;
  const double b1 = behind * behind + smoothness;
  const double bend = (ahead - behind) * (ahead - behind);
  const double w0 = 2.0 * (b0 + bend) * b1;
  const double w1 = (b1 + bend) * b0;
  return at + 0.5 * (behind + (w0 / (w0 + w1)) * (ahead - behind));
}

/// Adds to out, or begins it.
template <bool adds>
inline __attribute__((always_inline)) void convect(int n, std::ptrdiff_t s, std::ptrdiff_t across,
                                                   double inverse_h, double smoothness,
                                                   const double* flux, const double* u,
                                                   double* out) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double high = 0.5 * (flux[i + s] + flux[i + s - across]);
    const double low = 0.5 * (flux[i] + flux[i - across]);
    const double m2 = u[i - 2 * s];
    const double m1 = u[i - s];
    const double c = u[i];
    const double p1 = u[i + s];
    const double p2 = u[i + 2 * s];
    const bool high_out = high > 0.0;
    const bool low_in = low > 0.0;
    const double at_high =
        face_value(high_out ? m1 : p2, high_out ? c : p1, high_out ? p1 : c, smoothness);
    const double at_low =
        face_value(low_in ? m2 : p1, low_in ? m1 : c, low_in ? c : m1, smoothness);
    const double before = adds ? out[i] : 0.0;
    out[i] = before + inverse_h * (high * (at_high - c) - low * (at_low - c));
  }
}
DUST_KERNEL void convect_row(int n, std::ptrdiff_t s, std::ptrdiff_t across, double inverse_h,
                             double smoothness, const double* flux, const double* u, double* out) {
  convect<true>(n, s, across, inverse_h, smoothness, flux, u, out);
}
DUST_KERNEL void begin_convect_row(int n, std::ptrdiff_t s, std::ptrdiff_t across, double inverse_h,
                                   double smoothness, const double* flux, const double* u,
                                   double* out) {
  convect<false>(n, s, across, inverse_h, smoothness, flux, u, out);
}

DUST_KERNEL void divide_by_face_eps_row(int n, std::ptrdiff_t across, const double* eps,
                                        double* out) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) out[i] /= 0.5 * (eps[i] + eps[i - across]);
}

DUST_KERNEL void flux_row(int n, std::ptrdiff_t across, const double* eps, const double* u,
                          double* flux) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) flux[i] = 0.5 * (eps[i] + eps[i - across]) * u[i];
}

DUST_KERNEL void inverse_row(int n, double implicit, double sum, double inverse_density,
                             const double* coefficient, const FaceKind* kind, double* inverse) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double d = 1.0 / (1.0 + implicit * (coefficient[i] * inverse_density + sum));
    inverse[i] = kind[i] == FaceKind::plain ? d : 0.0;
  }
}

/// The same with viscosity and 1 / inertia per face; `sum` in 1/m2.
DUST_KERNEL void inverse_row_each(int n, double implicit, double sum, const double* inertia,
                                  const double* viscosity, const double* coefficient,
                                  const FaceKind* kind, double* inverse) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double d = 1.0 / (1.0 + implicit * inertia[i] * (coefficient[i] + viscosity[i] * sum));
    inverse[i] = kind[i] == FaceKind::plain ? d : 0.0;
  }
}

/// Numbers of a row that are found first and then put in, every other one. In one go, each next to
/// those that its neighbours read, the loop would have to go number by number.
constexpr int k_block = 256;

/// u += omega (t - u) at every other number of a row, t = value(i) reading neighbours along x.
template <class Value>
inline __attribute__((always_inline)) void sweep(int n, int parity, double omega,
                                                 const double* inverse, double* u,
                                                 const Value& value) {
  if constexpr (k_visits_one_colour) {
    for (int i = parity; i < n; i += 2) {
      if (inverse[i] > 0.0) u[i] += omega * (value(i) * inverse[i] - u[i]);
    }
    return;
  }
  alignas(64) double next[k_block];
  for (int first = 0; first < n; first += k_block) {
    const int count = std::min(k_block, n - first);
#pragma GCC ivdep
    for (int q = 0; q < count; ++q) {
      const double old = u[first + q];
      next[q] = old + omega * (value(first + q) * inverse[first + q] - old);
    }
#pragma GCC ivdep
    for (int q = 0; q < count; ++q) {
      const bool takes = inverse[first + q] > 0.0 && ((first + q + parity) & 1) == 0;
      u[first + q] = takes ? next[q] : u[first + q];
    }
  }
}

DUST_KERNEL void sweep_row(int n, std::ptrdiff_t sy, std::ptrdiff_t sz, int parity, double omega,
                           double ax, double y_low, double y_high, double z_low, double z_high,
                           const double* right, const double* inverse, double* u) {
  sweep(n, parity, omega, inverse, u, [=](int i) {
    return right[i] + ax * (u[i - 1] + u[i + 1]) + y_low * u[i - sy] + y_high * u[i + sy] +
           z_low * u[i - sz] + z_high * u[i + sz];
  });
}

/// The same where nothing varies along y.
DUST_KERNEL void flat_sweep_row(int n, std::ptrdiff_t sz, int parity, double omega, double ax,
                                double z_low, double z_high, const double* right,
                                const double* inverse, double* u) {
  sweep(n, parity, omega, inverse, u, [=](int i) {
    return right[i] + ax * (u[i - 1] + u[i + 1]) + z_low * u[i - sz] + z_high * u[i + sz];
  });
}

/// The same with viscosity and 1 / inertia per face; weights in s/m2.
DUST_KERNEL void sweep_row_each(int n, std::ptrdiff_t sy, std::ptrdiff_t sz, int parity,
                                double omega, double ax, double y_low, double y_high, double z_low,
                                double z_high, const double* inertia, const double* viscosity,
                                const double* right, const double* inverse, double* u) {
  sweep(n, parity, omega, inverse, u, [=](int i) {
    const double around = ax * (u[i - 1] + u[i + 1]) + y_low * u[i - sy] + y_high * u[i + sy] +
                          z_low * u[i - sz] + z_high * u[i + sz];
    return right[i] + viscosity[i] * inertia[i] * around;
  });
}

DUST_KERNEL void scale_row(int n, const double* factor, double* values) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) values[i] *= factor[i];
}

DUST_KERNEL void laplace_row(int n, std::ptrdiff_t sy, std::ptrdiff_t sz, double ax, double ay,
                             double az, const double* u, const FaceKind* kind, double* out) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double l = ax * ((u[i - 1] - u[i]) + (u[i + 1] - u[i])) +
                     ay * ((u[i - sy] - u[i]) + (u[i + sy] - u[i])) +
                     az * ((u[i - sz] - u[i]) + (u[i + sz] - u[i]));
    out[i] = is_unknown(kind[i]) ? l : 0.0;
  }
}

struct RowRates {
  double courant = 0.0;
  double speed = 0.0;
  double bad = 0.0;
};

// Ghost faces carry mirrored values that nothing is carried with: left out. A number that is not
// finite makes its product with 0 differ from 0 and stays in the sum.
DUST_KERNEL void rate_row(int n, std::ptrdiff_t sy, std::ptrdiff_t sz, double hx, double hy,
                          double hz, const FaceKind* ku, const FaceKind* kv, const FaceKind* kw,
                          const double* u, const double* v, const double* w, double* courant,
                          double* speed, double* bad) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double u0 = ku[i] == FaceKind::inside ? 0.0 : std::abs(u[i]);
    const double u1 = ku[i + 1] == FaceKind::inside ? 0.0 : std::abs(u[i + 1]);
    const double v0 = kv[i] == FaceKind::inside ? 0.0 : std::abs(v[i]);
    const double v1 = kv[i + sy] == FaceKind::inside ? 0.0 : std::abs(v[i + sy]);
    const double w0 = kw[i] == FaceKind::inside ? 0.0 : std::abs(w[i]);
    const double w1 = kw[i + sz] == FaceKind::inside ? 0.0 : std::abs(w[i + sz]);
    const double a = u0 > u1 ? u0 : u1;
    const double b = v0 > v1 ? v0 : v1;
    const double c = w0 > w1 ? w0 : w1;
    courant[i] = a * hx + b * hy + c * hz;
    const double ab = a > b ? a : b;
    speed[i] = ab > c ? ab : c;
    bad[i] = 0.0 * (u[i] + v[i] + w[i]);
  }
}

RowRates largest_of(int n, const double* courant, const double* speed, const double* bad) {
  double c[4] = {};
  double s[4] = {};
  double b[4] = {};
  for (int i = 0; i < n; ++i) {
    const int l = i & 3;
    c[l] = courant[i] > c[l] ? courant[i] : c[l];
    s[l] = speed[i] > s[l] ? speed[i] : s[l];
    b[l] += bad[i];
  }
  return {std::max(std::max(c[0], c[1]), std::max(c[2], c[3])),
          std::max(std::max(s[0], s[1]), std::max(s[2], s[3])), b[0] + b[1] + b[2] + b[3]};
}

}  // namespace
}  // namespace dust::fluid
// NOLINTEND(misc-definitions-in-headers)

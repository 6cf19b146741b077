// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hertz_mindlin.hpp"

#include <algorithm>
#include <cmath>

namespace dust::model::hertz_mindlin {

/// The tangential force by the conventions of LIGGGHTS (`model hertz tangential history`), for
/// parameters that were calibrated there. The normal force is that of this law.
///
/// \f[ \xi \leftarrow \xi + u - \bigl((\xi + u) \cdot n\bigr)\, n, \qquad
///     F_t = -k_t \xi - \gamma_t v_t \quad \text{where}\ k_t |\xi| \le \mu_s |F_n|, \f]
/// \f[ \text{else}\quad F_t = -\mu_s |F_n|\, \xi / |\xi|, \quad
///     \xi \leftarrow \mu_s |F_n| / k_t\; \xi / |\xi| \f]
///
/// with \f$ k_t = 8 G^* \sqrt{R^* d} \f$ of now, \f$ \gamma_t = -2 \beta \sqrt{5/6} \sqrt{k_t m^*}
/// \f$ without a bound, and F_n with its damper. What differs from the law of this engine: the
/// spring alone is held against the limit, so that spring and damper together may pass it; the
/// damper ends where the contact slides; an attracting normal force holds like a repelling one; the
/// spring is projected into the contact plane, which shortens it, and its whole length has the
/// stiffness of now, so that unloading drains its energy and loading makes some.
///
/// Valid as the law itself. In touch only: all zero for d <= 0.
/// Source: Kloss, Goniva, Hager, Amberger, Pirker, Prog. Comput. Fluid Dyn. 12 (2012) 140,
/// doi:10.1504/PCFD.2012.047457, and the released program, version 3.8.0 (its source and manual).
[[gnu::always_inline]] inline void evaluate_liggghts(const Constants& k, Contact& c) {
  const double touch = c.overlap > 0.0 ? 1.0 : 0.0;
  const double d = std::max(c.overlap, 0.0);
  const double a = std::sqrt(c.radius * d);
  const double kn = 4.0 / 3.0 * k.young * a;
  const double kt = 8.0 * k.shear * a;
  const double shared = k.damping * std::sqrt(a * c.mass);
  const double gt = shared * k.tangential_root;
  const double vn = c.vx * c.nx + c.vy * c.ny + c.vz * c.nz;
  const double fn = kn * d - shared * k.normal_root * vn;

  const double x = c.sx + c.ux;
  const double y = c.sy + c.uy;
  const double z = c.sz + c.uz;
  const double along = x * c.nx + y * c.ny + z * c.nz;
  const double sx = touch * (x - along * c.nx);
  const double sy = touch * (y - along * c.ny);
  const double sz = touch * (z - along * c.nz);

  const double spring = kt * std::sqrt(sx * sx + sy * sy + sz * sz);
  const double limit = k.friction * std::abs(fn);
  const double cap = std::min(1.0, limit / std::max(spring, k_tiny));
  const double damper = spring > limit ? 0.0 : gt;
  c.sx = cap * sx;
  c.sy = cap * sy;
  c.sz = cap * sz;
  c.stiffness = kt;
  c.normal_force = fn;
  c.normal_stiffness = kn;
  c.fx = fn * c.nx - kt * c.sx - damper * (c.vx - vn * c.nx);
  c.fy = fn * c.ny - kt * c.sy - damper * (c.vy - vn * c.ny);
  c.fz = fn * c.nz - kt * c.sz - damper * (c.vz - vn * c.nz);
}

}  // namespace dust::model::hertz_mindlin

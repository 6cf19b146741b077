// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/boundary_condition.hpp"
#include "dust/sdk/error.hpp"
#include "dust/sdk/parameter_schema.hpp"
#include "dust/sdk/table.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace dust::sdk {

/// A course in time that a flow or speed is multiplied by: the `Parameters` of a model derive from
/// this, its schema calls declare_course, and CourseParameters::over_time makes the factor.
struct CourseParameters {
  std::vector<double> times;    ///< [s]
  std::vector<double> factors;  ///< [-]

  [[nodiscard]] Table over_time() const { return {times, factors, "times", "factors"}; }
};
/// `what` is the parameter that is multiplied: "flow".
template <class P>
void declare_course(SchemaOf<P>& s, const std::string& what) {
  s.numbers(&P::times, "times", dimension::time, "Times of the factors.").optional();
  s.numbers(&P::factors, "factors", dimension::none,
            "What " + what + " is multiplied by at each of times; straight lines between.")
      .symbol("g")
      .optional();
}

/// What the solver is asked for where the flow through a side is given.
inline SideRules flow_rules(SideRule tangential_velocity = SideRule::fixed) {
  return {.normal_velocity = SideRule::fixed,
          .tangential_velocity = tangential_velocity,
          .pressure = SideRule::gradient};
}

/// Number of the axis that a side's normal points along.
inline int axis_of(Vec3 normal) { return normal.x != 0.0 ? 0 : normal.y != 0.0 ? 1 : 2; }

/// Sets the velocity of all points to zero.
inline void set_at_rest(const SideBatch& batch) {
  for (std::size_t n = 0; n < batch.count; ++n) {
    batch.velocity.x[n] = 0.0;
    batch.velocity.y[n] = 0.0;
    batch.velocity.z[n] = 0.0;
  }
}

/// Sets the interstitial velocity along the inward normal to what `superficial(n)` [m/s] makes of
/// point n, over the void fraction there; docs/theory/fluid.md, eq. (10).
template <class Speed>
void set_superficial(const SideBatch& batch, const Speed& superficial) {
  const std::array<double*, 3> velocity{batch.velocity.x, batch.velocity.y, batch.velocity.z};
  const int d = axis_of(batch.normal);
  double* const out = velocity[static_cast<std::size_t>(d)];
  const double inward = -batch.normal[d];
  for (std::size_t n = 0; n < batch.count; ++n) {
    out[n] = inward * superficial(n) / batch.void_fraction[n];
  }
}

/// Lets the volume flow `flow` [m3/s] in (out, if negative): superficial velocities in the ratio of
/// `shape(n)` >= 0 over the open areas, scaled so that their sum over the side is the flow.
template <class Shape>
void set_volume_flow(const SideBatch& batch, double flow, const Shape& shape) {
  if (batch.area == nullptr) return;  // tangential components: at rest
  double sum = 0.0;
  for (std::size_t n = 0; n < batch.count; ++n) sum += shape(n) * batch.area[n];
  if (!(sum > 0.0)) {
    if (flow == 0.0) return;
    throw ModelError("a volume flow is given on a side that has no open area for it");
  }
  set_superficial(batch, [&](std::size_t n) { return flow / sum * shape(n); });
}

}  // namespace dust::sdk

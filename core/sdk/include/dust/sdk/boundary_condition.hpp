// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/columns.hpp"
#include "dust/sdk/model.hpp"
#include "dust/sdk/vec3.hpp"

#include <cstddef>

namespace dust::sdk {

/// How the fluid solver treats one component of the velocity, or the pressure, on a side.
enum class SideRule {
  fixed,     ///< the value is given on the side itself
  gradient,  ///< zero normal gradient
  pressure,  ///< (pressure only) total pressure: p + rho u_n^2 / 2 = value on inflow, p = value on
             ///< outflow; with a tangential velocity of zero gradient what enters brings none
  periodic,  ///< joined to the opposite side
};

/// What a boundary asks of the solver, once, at the start. Two combinations make sense: normal
/// velocity `fixed` with pressure `gradient` (walls, inlets), and normal velocity `gradient` with
/// pressure `fixed` or `pressure` (open sides); the solver refuses others.
struct SideRules {
  SideRule normal_velocity = SideRule::fixed;
  SideRule tangential_velocity = SideRule::fixed;
  SideRule pressure = SideRule::gradient;
};

/// Whether rules determine the flow: normal velocity and pressure fixed and gradient (walls,
/// inlets) or gradient and fixed or total pressure (open sides); the tangential velocity fixed or
/// of zero gradient.
inline bool can_be_solved(const SideRules& r) {
  const bool is_given = r.normal_velocity == SideRule::fixed && r.pressure == SideRule::gradient;
  const bool is_open = r.normal_velocity == SideRule::gradient &&
                       (r.pressure == SideRule::fixed || r.pressure == SideRule::pressure);
  return (is_given || is_open) &&
         (r.tangential_velocity == SideRule::fixed || r.tangential_velocity == SideRule::gradient);
}

/// Points on the side at which values are wanted.
struct SideBatch {
  std::size_t count = 0;
  double time = 0.0;              ///< [s]
  Vec3 normal;                    ///< unit vector out of the domain
  VectorColumns position;         ///< [m]
  MutableVectorColumns velocity;  ///< [m/s] out, where a component is `fixed`; interstitial
  double* pressure = nullptr;     ///< [Pa] out, where pressure is `fixed` or `pressure`
  Vec3 low;                       ///< [m] corners of the side
  Vec3 high;
  Vec3 spacing;  ///< [m] of the fluid's cells; a point of the normal velocity is a face's centre
  /// The rest only for models with BoundaryCondition::needs_flow, null elsewhere.
  const double* void_fraction = nullptr;  ///< [-] in the cells next to the points
  /// Density of the fluid in these cells [kg/m3] and open area of the faces round the points [m2];
  /// null in calls for tangential components and pressure.
  const double* density = nullptr;
  const double* area = nullptr;
};

/// Air condition on one side of the domain. A pure function of time and place.
class BoundaryCondition : public Model {
 public:
  static constexpr const char* k_kind = "boundary";
  [[nodiscard]] virtual SideRules rules() const = 0;
  virtual void evaluate(const SideBatch& batch) const = 0;
  /// Does `evaluate` read void fraction, density and area? Asked once, at the start.
  [[nodiscard]] virtual bool needs_flow() const { return false; }
};

}  // namespace dust::sdk

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/boundary_condition.hpp"
#include "registry/registry.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <array>
#include <memory>
#include <vector>

namespace dust::preflight {

/// The air's models of the six sides, in the order of scenario::k_side_names; null where periodic
/// or wrong.
using SideModels = std::array<const sdk::BoundaryCondition*, 6>;

/// Makes them.
class SideModelSet {
 public:
  SideModelSet(const scenario::Setup& setup, const registry::Registry& registry);
  [[nodiscard]] const SideModels& models() const { return models_; }

 private:
  std::array<std::unique_ptr<sdk::BoundaryCondition>, 6> made_;
  SideModels models_{};
};

/// Tells sides that cannot be solved together, with the reason: what a model refuses on its side,
/// rules that do not go together, flows that no side gives way to. Flows are added up over whole
/// sides at some times of the run; where bodies may cover part of a side, only flows that are all
/// of one sign are refused. Warns of cells far from cubic.
void check_flow(const scenario::Setup& setup, const SideModels& sides,
                scenario::Diagnostics& diagnostics);

/// Warns of openings and sides that drive the fluid faster than what its equations hold for, a
/// third of the speed of sound in air: mostly a wrong unit.
void check_driven_speed(const scenario::Setup& setup, const SideModels& sides,
                        const std::vector<scenario::SideOpeningSpec>& openings,
                        scenario::Diagnostics& diagnostics);

/// [m3/s] Into the domain, of each side that drives the fluid at a given rate, where it is largest;
/// 0 of the others and of those that a check has no memory for.
std::array<double, 6> side_flows(const scenario::Setup& setup, const SideModels& sides);

/// Tells sensors of wall shear on sides that have none, or whose viscosity they do not know.
void check_wall_shear(const scenario::Setup& setup, const SideModels& sides,
                      const registry::Registry& registry, scenario::Diagnostics& diagnostics);

/// Does air pass a side, in or out, at some times of the run? `model`: its own, null where
/// periodic.
bool passes_air(const scenario::Setup& setup, std::size_t side,
                const sdk::BoundaryCondition* model);

/// [m/s] Largest speed at which sides and openings of bodies drive the fluid, at some times of the
/// run; 0 without any. A side that a check has no memory for counts as none.
double driven_speed(const scenario::Setup& setup, const SideModels& sides);

/// [m/s] The same of what is driven through whole sides: it is the speed of the fluid in much of
/// the domain, unlike that at the edges of an opening.
double wind_speed(const scenario::Setup& setup, const SideModels& sides);

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace dust::fluid {

/// Form of the volume-averaged momentum equation (docs/theory/coupling.md, docs/theory/fluid.md):
/// in the sets I and II, one equation here, the particles have their volume's part of the stress;
/// set III has the inertia of the fluid in a unit of volume, and that part of the stress in the
/// drag.
enum class MomentumSet { one, two, three };

/// As scenarios write it: I, II or III.
[[nodiscard]] constexpr MomentumSet momentum_set_of(std::string_view name) {
  if (name == "III") return MomentumSet::three;
  return name == "II" ? MomentumSet::two : MomentumSet::one;
}

/// Fluid per control volume [-] that a density of force acts on, at the void fraction `eps`.
[[nodiscard]] constexpr double fluid_fraction(MomentumSet set, double eps) {
  return set == MomentumSet::three ? 1.0 : eps;
}

}  // namespace dust::fluid

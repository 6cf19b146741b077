// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace dust::scenario {

/// The kinds of forces on grains that a run tells apart.
enum class ForceKind : std::size_t {
  gravity,
  buoyancy,        ///< of the hydrostatic pressure
  contact_normal,  ///< what grains and walls press
  contact_tangential,
  attraction,         ///< what holds them together: contacts that pull
  pressure_gradient,  ///< of the fluid's own pressure, in the cell of the grain
  drag                ///< all else that the fluid does
};
inline constexpr std::size_t k_force_kinds = 7;
/// As the summary names them.
inline constexpr std::array<const char*, k_force_kinds> k_force_names = {
    "gravity",           "buoyancy", "contact_normal", "contact_tangential", "attraction",
    "pressure_gradient", "drag"};

}  // namespace dust::scenario

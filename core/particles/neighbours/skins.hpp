// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cstddef>

namespace dust::particles {

class ReferenceTrajectories;

/// What skins are chosen from.
struct SkinInput {
  const double* position = nullptr;  ///< rows: x, y, z, radius [m]
  std::size_t count = 0;
  std::size_t coarse_count = 0;    ///< those at the front
  double skin_in_diameters = 0.0;  ///< of coarse particles
  double largest_diameter = 0.0;   ///< [m]
  sdk::Vec3 origin;                ///< [m] of the cells in which crowds are counted

  [[nodiscard]] double diameter(std::size_t n) const { return 2.0 * position[4 * n + 3]; }
};

/// The skins of the next outer list: of a coarse particle in proportion to its diameter, of a fine
/// one by the room it has.
void choose_skins(const SkinInput& in, ReferenceTrajectories& trajectories);

}  // namespace dust::particles

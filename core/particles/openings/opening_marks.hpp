// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/openings/opening.hpp"
#include "particles/surfaces.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dust::particles {

/// Where contacts with surfaces note the particles that touch an opening: views of what others own.
struct OpeningMarks {
  std::span<const Opening> openings;
  double rounding = 0.0;                ///< [m]
  std::span<std::int32_t> of_particle;  ///< by row: number of the opening, -1 = none

  /// A particle touches, at `point`, a surface that has an opening.
  void note(const Surface& surface, std::int32_t row, sdk::Vec3 point) const {
    const Opening& opening = openings[static_cast<std::size_t>(surface.opening)];
    if (!opening.holds(surface.in_own_frame(point), rounding)) return;
    of_particle[static_cast<std::size_t>(row)] = surface.opening;
  }
};

}  // namespace dust::particles

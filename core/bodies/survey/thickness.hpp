// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"

#include <optional>

namespace dust::bodies {

/// Where a body is thin.
struct ThinPlace {
  double thickness = 0.0;  ///< [m] along the normal of its surface
  double cell = 0.0;       ///< [m] of a cell along that normal
  sdk::Vec3 place;         ///< [m] on its surface
};

/// The thinnest place of those points of a body's surface in the box from `min` to `max` [m] where
/// it is thinner than `cell` [m] is wide; none on bodies without an inside. Looks at some 10^4
/// points of the surface at most, where the body is as the run begins: edges that taper off between
/// them are not seen.
[[nodiscard]] std::optional<ThinPlace> thinnest_place(const Body& body, sdk::Vec3 min,
                                                      sdk::Vec3 max, sdk::Vec3 cell);

}  // namespace dust::bodies

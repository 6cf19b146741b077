// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/shape.hpp"
#include "dust/sdk/vec3.hpp"

#include <utility>
#include <vector>

namespace dust::bodies {

/// The edges of a surface that a line drawing seen along axis `depth` (0 to 2) shows: rims, sharp
/// bends, and where the surface turns from the eye. Corners nearer than 1e-7 `size` [m] are one.
std::vector<std::pair<sdk::Vec3, sdk::Vec3>> visible_edges(const Triangles& triangles, int depth,
                                                           double size);

}  // namespace dust::bodies

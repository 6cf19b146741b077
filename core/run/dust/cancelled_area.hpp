// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/geometry/body_field.hpp"

namespace dust::run {

/// Area that looks up of a body's surface in a box, seen in plan and over the volume of the box
/// [1/m], as far as area that looks down cancels it in the sum of both: where an edge of the body
/// stands out into the box. Of the change of the open share between the points of a lattice, eight
/// to an edge of the box. 0 where two bodies meet, and where the surfaces look away from each
/// other: what is below a thin body is another cell's.
[[nodiscard]] double cancelled_area(const fluid::BodyField& bodies, sdk::Vec3 centre,
                                    sdk::Vec3 size, sdk::Vec3 up);

}  // namespace dust::run

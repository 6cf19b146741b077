// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"

namespace dust::bodies {

/// Whether the surface of a body may meet the box round `middle` with half edges `half` [m]; false
/// only where no part of it does. Parts of the box that are farther from it than they reach are
/// left out, others halved along their longest edge; one that reaches no farther than `finest` [m]
/// and is that near counts as met.
[[nodiscard]] bool may_meet_box(const Body& body, const Placement& placement, sdk::Vec3 middle,
                                sdk::Vec3 half, double finest);

}  // namespace dust::bodies

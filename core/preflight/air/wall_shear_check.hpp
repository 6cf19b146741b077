// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/air/side_faces.hpp"
#include "scenario/diagnostics.hpp"

namespace dust::preflight {

/// Tells sensors of wall shear on sides that have none, or whose viscosity they do not know.
void check_wall_shear(const scenario::Setup& setup, const SideModels& sides,
                      const registry::Registry& registry, scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight

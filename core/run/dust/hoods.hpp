// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/openings/opening.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <vector>

namespace dust::run {

/// Where a run draws air out together with what floats in it: bodies with suction, in the order of
/// the scenario, then openings in sides.
std::vector<particles::Opening> openings_of(const scenario::Setup& setup,
                                            const scenario::DustSetup& dust);

/// Behind the name of a side: what sinks out of it beside its hood.
inline constexpr const char* k_beside_hood = "_beside_hood";

}  // namespace dust::run

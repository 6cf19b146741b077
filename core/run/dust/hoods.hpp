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

}  // namespace dust::run

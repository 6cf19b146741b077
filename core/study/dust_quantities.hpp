// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/quantities.hpp"

#include <vector>

namespace dust::study {

/// What a run of `setup` will tell of dust, beside its sensors: what hoods draw out, the dust in
/// the air, on surfaces and on grains by size class, and the steady rates.
std::vector<Quantity> dust_quantities(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                      const registry::Registry& registry);

}  // namespace dust::study

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/liberation_law.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <string>
#include <vector>

namespace dust::run {

/// What a law makes of moisture, a line for each material that carries dust, also without any: the
/// dust that a gentle impact sets free of it over what it would at 1 %, and what none counts as.
/// None of laws that do not read the moisture, or set none free by impacts as gentle. `law` is
/// prepared.
std::vector<std::string> moisture_lines(const sdk::LiberationLaw& law,
                                        const std::vector<scenario::MaterialSpec>& materials,
                                        const std::vector<scenario::DustLoadSpec>& loads);

}  // namespace dust::run

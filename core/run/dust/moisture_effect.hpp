// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/liberation_law.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <optional>
#include <string>
#include <vector>

namespace dust::run {

/// What a law makes of the moisture of a grain with these shares of dust [-]: the dust that a
/// gentle impact sets free of it over what it would at `reference`, moisture [-] both; nothing
/// where the law does not set any free then. `law` is prepared.
std::optional<double> moisture_effect(const sdk::LiberationLaw& law,
                                      const scenario::DustLoadSpec& load, double reference);

/// A line for each material whose moisture the law reads.
std::vector<std::string> moisture_lines(const sdk::LiberationLaw& law,
                                        const std::vector<scenario::MaterialSpec>& materials,
                                        const std::vector<scenario::DustLoadSpec>& loads);

}  // namespace dust::run

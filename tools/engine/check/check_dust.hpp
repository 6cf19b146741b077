// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/emissions.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace dust::engine {

/// Classes of the dust field, what the emitters' material brings of it, what sets it free and who
/// catches it, for a person; nothing where no dust is computed as a field.
std::string dust_text(const scenario::Setup& setup, const scenario::DustSetup& dust,
                      std::span<const preflight::EmissionNumbers> emissions);

/// Adds "dust" to the numbers of a check: classes_m, and brought_kg_per_s of streams by class.
void add_dust_json(const scenario::Setup& setup, const scenario::DustSetup& dust,
                   std::span<const preflight::EmissionNumbers> emissions,
                   nlohmann::ordered_json& json);

}  // namespace dust::engine

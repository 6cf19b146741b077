// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <nlohmann/json.hpp>

namespace dust::run {

/// The models a scenario uses, each once, with the version it gives itself: [{"kind", "name",
/// "version"}], sorted.
nlohmann::ordered_json plugins_json(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                    const registry::Registry& registry);

/// Where things are, for pictures: {"domain": {"min", "max"}, "sides": [{"name", "grains",
/// "material" of a wall, "air"}], "bodies": [{"name", "shape", "motions", "material"}] (both with
/// "flow_m3_per_s" where they draw out), "regions"
/// of other fluids: [{"min", "max"}], "belts": level bodies with a surface speed [{"name", "speed",
/// "radius" of a pulley}], "emitters" and "sensors": [{"name", "model", "what", "min", "max" |
/// "at"}]}, in m and in the domain's frame. A model without a place has neither.
nlohmann::ordered_json setting_json(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                    const registry::Registry& registry);

}  // namespace dust::run

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/parameter_schema.hpp"

#include <nlohmann/json_fwd.hpp>

namespace dust::scenario {

/// JSON Schema (draft-07) of what MapReader reads as this parameter.
[[nodiscard]] nlohmann::ordered_json value_schema(const sdk::Parameter& parameter);

/// Of one number in its range, bare or with a unit.
[[nodiscard]] nlohmann::ordered_json number_schema(const sdk::Parameter& parameter);

/// "properties" with one for each parameter of a schema.
[[nodiscard]] nlohmann::ordered_json property_schemas(const sdk::ParameterSchema& schema);

}  // namespace dust::scenario

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace dust::contract {

/// Values with which the factory makes a model: those given, the defaults, and for the others
/// typical values of their dimension within their range. Throws NotTested that names the
/// parameters to give when none of the attempts is accepted. Of those accepted the first is taken
/// with which the model `is_usable` in the standard scene (a box that lies on a side), else the
/// first.
std::vector<sdk::Value> default_values(
    const sdk::ModelInfo& info, const sdk::ModelFactory& factory,
    const std::map<std::string, sdk::Value>& given,
    const std::function<bool(const std::vector<sdk::Value>&)>& is_usable);

/// Other values a parameter might have, each within its range, the most different first; empty
/// where nothing can be guessed (names of the scenario's things, free text).
std::vector<sdk::Value> other_values(const sdk::Parameter& parameter, const sdk::Value& value);

}  // namespace dust::contract

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/body_survey.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace dust::engine {

/// Meshes and narrow gaps between bodies, for a person; nothing where there are none.
std::string bodies_text(const preflight::BodySurvey& survey);

/// Adds "meshes" and "gaps" to the numbers of a check.
void add_bodies_json(const preflight::BodySurvey& survey, nlohmann::ordered_json& json);

}  // namespace dust::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"

#include <nlohmann/json.hpp>

namespace dust::report {

/// What the page of a set-up that has not run yet is made of (kind "setup"): the bodies in outline,
/// cut in the middle and in three dimensions; `setting` says where emitters and sensors are, as in
/// the document of a run, `check` what the run will cost.
[[nodiscard]] nlohmann::json setup_document(const scenario::Setup& setup,
                                            const bodies::BodySet& bodies,
                                            const nlohmann::json& setting,
                                            const nlohmann::json& check);

}  // namespace dust::report

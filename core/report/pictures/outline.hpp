// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"

#include <nlohmann/json.hpp>

namespace dust::report {

/// Edges of the bodies as seen along y, where the scenario puts them: [{"body", "segments": [[[x,
/// z], [x, z]], ..]}] in m.
[[nodiscard]] nlohmann::ordered_json outline_of(const scenario::DomainSpec& domain,
                                                const bodies::BodySet& bodies);

/// What the plane across y through the middle of the domain cuts of a body: [[min x, min z, max x,
/// max z], ..] in m, rows of squares of 1/300 of the longer side of the view.
[[nodiscard]] nlohmann::ordered_json section_of(const scenario::DomainSpec& domain,
                                                const bodies::Body& body);

}  // namespace dust::report

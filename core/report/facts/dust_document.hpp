// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/highlights.hpp"

namespace dust::report {

/// Dust within this distance of a place counts as being there [m].
constexpr double k_reach = 0.02;

/// Side of the squares that tell where dust parted from the load [m].
constexpr double k_parting_side = 0.02;

/// What the run says of dust; null where it says nothing.
[[nodiscard]] nlohmann::json dust_json(const Highlights& highlights, const DustSizes& sizes);

/// The places of low pressure and which of them to extract at first; null without places.
[[nodiscard]] nlohmann::json extraction_json(const Highlights& highlights);

}  // namespace dust::report

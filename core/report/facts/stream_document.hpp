// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/highlights.hpp"

#include <vector>

namespace dust::report {

/// Quantiles of the stream: [{"drop", "low", "median", "high"}], each {"value", "error"} or null.
[[nodiscard]] nlohmann::json stream_json(const Highlights& highlights);

/// What single grains would do that leave level belts at the top of the head pulley, the reference
/// of the stream: [{"name", "speed", "gravity", "free", "lone"}]. `free` without air,
/// x = v sqrt(2 (h + s) / g) with s [m] by which a grain's centre stands over the start of the
/// stream, one or two sizes; `lone` alone in still air. Of several belts that whose head is nearest
/// to the start of the stream.
[[nodiscard]] nlohmann::json flights_json(const nlohmann::json& report, const DustSizes& dust,
                                          const std::vector<StreamDrop>& stream);

}  // namespace dust::report

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/highlights.hpp"

namespace dust::report {

/// Quantiles of the stream: [{"drop", "low", "median", "high"}], each {"value", "error"} or null.
[[nodiscard]] nlohmann::json stream_json(const Highlights& highlights);

/// Free flight without air from a level belt, x = v sqrt(2 h / g), the reference of the stream, and
/// paths of single grains in still air down to `deepest` [m].
[[nodiscard]] nlohmann::json flights_json(const nlohmann::json& report, const DustSizes& dust,
                                          double deepest);

}  // namespace dust::report

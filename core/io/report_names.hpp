// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/report_run.hpp"

#include <string>

namespace dust::io {

/// What the names of sensors and figures say, by convention: "class_10_um/net/grams_per_tonne",
/// "drop_140_mm/median", "dust_out_below_belt".

[[nodiscard]] bool has_part(const std::string& text, const char* part);

/// The last word of a path: "median" of "drop_140_mm/median".
[[nodiscard]] std::string leaf_of(const std::string& path);

/// 5, 50 or 95 when a figure's last word names that quantile, else 0.
[[nodiscard]] int quantile_of(const std::string& path);

/// The drop in "drop_140_mm/median" [m]; negative when the path names none.
[[nodiscard]] double drop_of(const std::string& path);

/// The diameter in "class_10_um/grams_per_tonne" [m]; negative when the path names no size class.
[[nodiscard]] double class_of(const std::string& path);

[[nodiscard]] bool is_per_tonne(const Figure& figure);

/// A sensor with "out" among the words of its name watches an opening.
[[nodiscard]] bool is_opening(const std::string& sensor);

/// The place a sensor's name tells, in words: "below belt" of "dust_out_below_belt".
[[nodiscard]] std::string place_words(const std::string& sensor);

}  // namespace dust::io

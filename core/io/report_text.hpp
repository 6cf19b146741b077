// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace dust::io {

/// Text made safe for HTML text and quoted attributes. Bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string escape_html(std::string_view text);

/// JSON that may stand inside a script element: no '<', no line separators of JavaScript.
[[nodiscard]] std::string script_json(const nlohmann::json& value);

/// A path of snake_case words to be read: "drop_140_mm/median" becomes "drop 140 mm / median".
[[nodiscard]] std::string words(std::string_view name);

/// A number with `digits` significant digits, a true minus and powers of ten in HTML.
[[nodiscard]] std::string number_html(double value, int digits = 4);

/// A whole number in groups of three, separated by narrow spaces.
[[nodiscard]] std::string count_html(double value);

/// "128.04 &plusmn; 0.12": the error with two significant digits, the value cut at the same place.
/// A negative error means that there is none.
[[nodiscard]] std::string value_html(double value, double error);

/// A value and its error in the unit that reads best (m -> mm or um, kg -> g, mg or ug, ...).
[[nodiscard]] std::string quantity_html(double value, double error, std::string_view unit);

/// A fraction of a whole in per cent, one decimal, cut back to 0 to 100; the sign is the caller's.
[[nodiscard]] std::string percent_of_whole(double fraction);

/// "1 h 02 min", "3 min 20 s", "12.4 s".
[[nodiscard]] std::string duration_html(double seconds);

/// Bytes as base64 of their zlib stream.
[[nodiscard]] std::string packed(std::span<const std::uint8_t> bytes);

}  // namespace dust::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/dimension.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace dust::scenario {

/// What a unit means: value in SI = number * numerator / denominator. Both are kept apart, so that
/// `350 mm` is the double nearest to 0.35 and not 350 times a rounded thousandth.
struct Unit {
  double numerator = 1.0;
  double denominator = 1.0;
  sdk::Dimension dimension;
  bool is_share = false;  ///< a percentage: allowed where a bare number is expected
};

/// Reads `mm`, `kg/m3`, `l/min`, `Pa s`, `N/(m s)`, `m^2`; nothing where it is not a known unit.
std::optional<Unit> parse_unit(std::string_view text);

/// The SI unit of a dimension as it is written: "kg/m3", "Pa s"; "" for a bare number.
std::string si_unit(sdk::Dimension dimension);
/// Name of a dimension for messages: "a length", "a mass flow".
std::string dimension_name(sdk::Dimension dimension);
/// Units a user may choose from: "m, mm, um, in, ft".
std::string example_units(sdk::Dimension dimension);

/// A number and the unit behind it, as written.
struct WrittenNumber {
  double number = 0.0;
  std::string unit;
};

/// Splits "1.25 mm". On failure nothing, and `error` says what to write instead.
std::optional<WrittenNumber> split_number(std::string_view text, std::string& error);

/// The value in SI of `number` in `unit` (may be empty: SI), which shall have `dimension`.
std::optional<double> to_si(const WrittenNumber& written, sdk::Dimension dimension,
                            std::string& error);

/// Shortest text that reads back as the same double.
std::string number_text(double value);

}  // namespace dust::scenario

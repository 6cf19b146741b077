// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// Numbers and durations as people read them: in messages, logs, tables and pages. What files keep
/// for machines is the shortest text that reads back as the same number.
namespace dust::base {

/// At most `digits` significant digits, without trailing zeros: "0.0123", "1.2e-07".
std::string digits_text(double value, int digits);
/// `decimals` digits behind the point, all of them.
std::string fixed_text(double value, int decimals);
/// One digit in front of the point, `decimals` behind it, and a power of ten: "1.20e-07".
std::string exponent_text(double value, int decimals);
/// The shortest text that reads back as the same double; "nan", "inf", "-inf".
std::string shortest_text(double value);

/// A time that has been measured: "12.3 s", "2 min 05 s", "3 h 20 min".
std::string duration_text(double seconds);
/// A time that has been estimated, two digits in one unit: "40 s", "98 min", "1.7 h".
std::string estimated_duration_text(double seconds);

}  // namespace dust::base

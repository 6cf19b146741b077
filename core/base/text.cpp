// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

namespace dust::base {
namespace {

constexpr double k_minute = 60.0;
constexpr double k_hour = 3600.0;

}  // namespace

std::string digits_text(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

std::string fixed_text(double value, int decimals) {
  return fmt::format("{:.{}f}", value, decimals);
}

std::string exponent_text(double value, int decimals) {
  return fmt::format("{:.{}e}", value, decimals);
}

std::string shortest_text(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  char digits[32];
  return {digits, std::to_chars(std::begin(digits), std::end(digits), value).ptr};
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 100.0) return digits_text(seconds, 3) + " s";
  const auto whole = std::llround(seconds);
  return whole < 3600 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                      : fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string estimated_duration_text(double seconds) {
  if (seconds < 2.0 * k_minute) return digits_text(std::max(seconds, 1.0), 2) + " s";
  // 98 min, but 1.7 h rather than "1e+02 min".
  if (seconds < 99.0 * k_minute) return digits_text(seconds / k_minute, 2) + " min";
  return digits_text(seconds / k_hour, seconds < 99.0 * k_hour ? 2 : 3) + " h";
}

}  // namespace dust::base

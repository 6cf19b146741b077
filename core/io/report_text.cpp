// SPDX-License-Identifier: Apache-2.0
#include "io/report_text.hpp"

#include "base/text.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace dust::io {

namespace {

constexpr const char* k_narrow_space = "\u202f";
constexpr const char* k_minus = "\u2212";

/// Length of the UTF-8 sequence at `at`, 0 when it is not well formed.
std::size_t sequence_length(std::string_view text, std::size_t at) {
  const auto byte = static_cast<unsigned char>(text[at]);
  std::size_t length = 0;
  if (byte < 0x80) return 1;
  if (byte >= 0xC2 && byte < 0xE0) length = 2;
  if (byte >= 0xE0 && byte < 0xF0) length = 3;
  if (byte >= 0xF0 && byte < 0xF5) length = 4;
  if (length == 0 || at + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((static_cast<unsigned char>(text[at + k]) & 0xC0) != 0x80) return 0;
  }
  return length;
}

std::string with_minus(std::string text) {
  if (!text.empty() && text[0] == '-') text.replace(0, 1, k_minus);
  return text;
}

struct Scale {
  const char* unit;
  double factor;  ///< of the unit in SI
};

/// The scales of a unit, largest first; the first that leaves a number of at least 1 is taken.
std::span<const Scale> scales_of(std::string_view unit) {
  static constexpr std::array k_length{Scale{"m", 1.0}, Scale{"mm", 1e-3}, Scale{"\u00b5m", 1e-6}};
  static constexpr std::array k_mass{Scale{"kg", 1.0}, Scale{"g", 1e-3}, Scale{"mg", 1e-6},
                                     Scale{"\u00b5g", 1e-9}, Scale{"ng", 1e-12}};
  static constexpr std::array k_rate{Scale{"kg/s", 1.0}, Scale{"g/s", 1e-3}, Scale{"mg/s", 1e-6},
                                     Scale{"\u00b5g/s", 1e-9}, Scale{"ng/s", 1e-12}};
  static constexpr std::array k_density{Scale{"kg/m\u00b3", 1.0}, Scale{"g/m\u00b3", 1e-3},
                                        Scale{"mg/m\u00b3", 1e-6}, Scale{"\u00b5g/m\u00b3", 1e-9}};
  static constexpr std::array k_flux{Scale{"kg/(m\u00b2 s)", 1.0}, Scale{"g/(m\u00b2 s)", 1e-3},
                                     Scale{"mg/(m\u00b2 s)", 1e-6}};
  // Two steps only: the rows of a table shall compare.
  static constexpr std::array k_share{Scale{"g/t", 1.0}, Scale{"mg/t", 1e-3}};
  static constexpr std::array k_time{Scale{"s", 1.0}, Scale{"ms", 1e-3}, Scale{"\u00b5s", 1e-6}};
  if (unit == "m") return k_length;
  if (unit == "kg") return k_mass;
  if (unit == "kg/s") return k_rate;
  if (unit == "kg/m3") return k_density;
  if (unit == "kg/(m2 s)" || unit == "kg/m2/s") return k_flux;
  if (unit == "g/t") return k_share;
  if (unit == "s") return k_time;
  return {};
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string safe;
  safe.reserve(text.size() + text.size() / 8);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = sequence_length(text, at);
    const char c = text[at];
    if (length == 0) {
      safe += "\ufffd";
      ++at;
      continue;
    }
    if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '&') {
      safe += "&amp;";
    } else if (c == '"') {
      safe += "&quot;";
    } else if (c == '\'') {
      safe += "&#39;";
    } else if (length == 1 && static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') {
      safe += ' ';
    } else {
      safe.append(text.substr(at, length));
    }
    at += length;
  }
  return safe;
}

std::string script_json(const nlohmann::json& value) {
  // Everything outside ASCII is written as \uXXXX, so only '<' is left to guard.
  const std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string words(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  for (auto at = text.find(" um"); at != std::string::npos; at = text.find(" um", at + 1)) {
    const bool is_unit = at + 3 == text.size() || text[at + 3] == '/' || text[at + 3] == ' ';
    if (is_unit) text.replace(at + 1, 1, "\u00b5");
  }
  for (auto at = text.find('/'); at != std::string::npos; at = text.find('/', at + 3)) {
    text.replace(at, 1, " / ");
  }
  return text;
}

std::string number_html(double value, int digits) {
  if (std::isnan(value)) return "\u2013";
  if (std::isinf(value)) return value > 0 ? "\u221e" : "\u2212\u221e";
  const double size = std::abs(value);
  if (size != 0.0 && (size < 1e-3 || size >= 1e6)) {
    const std::string text = base::exponent_text(value, digits - 1);
    const auto split = text.find('e');
    const int exponent = std::stoi(text.substr(split + 1));
    std::string mantissa = text.substr(0, split);
    if (mantissa.find('.') != std::string::npos) {
      mantissa.erase(mantissa.find_last_not_of('0') + 1);
      if (mantissa.back() == '.') mantissa.pop_back();
    }
    return with_minus(mantissa) + "\u202f\u00d7\u202f10<sup>" +
           with_minus(std::to_string(exponent)) + "</sup>";
  }
  // More figures before the point than asked for: still the whole number, not a power of ten.
  if (size >= std::pow(10.0, digits)) return count_html(value);
  const std::string text = base::digits_text(value, digits);
  // 99.97 with two figures rounds to a number with three before the point.
  if (text.find('e') != std::string::npos) return count_html(value);
  return with_minus(text);
}

std::string count_html(double value) {
  if (!std::isfinite(value)) return number_html(value);
  const std::string digits = base::fixed_text(std::abs(value), 0);
  std::string text;
  for (std::size_t k = 0; k < digits.size(); ++k) {
    if (k > 0 && (digits.size() - k) % 3 == 0) text += k_narrow_space;
    text += digits[k];
  }
  return value < 0 ? k_minus + text : text;
}

std::string value_html(double value, double error) {
  if (!(error > 0.0) || !std::isfinite(error) || !std::isfinite(value)) return number_html(value);
  const int place =
      static_cast<int>(std::floor(std::log10(error))) - 1;  // second digit of the error
  const double size = std::max(std::abs(value), error);
  if (size >= 1e6 || size < 1e-3) {
    const int exponent = static_cast<int>(std::floor(std::log10(size)));
    const int decimals = std::clamp(exponent - place, 0, 8);
    const double unit = std::pow(10.0, exponent);
    return "(" + with_minus(base::fixed_text(value / unit, decimals)) + "\u00a0\u00b1\u00a0" +
           base::fixed_text(error / unit, decimals) + ")\u202f\u00d7\u202f10<sup>" +
           with_minus(std::to_string(exponent)) + "</sup>";
  }
  const int decimals = std::clamp(-place, 0, 8);
  return with_minus(base::fixed_text(value, decimals)) + "\u00a0\u00b1\u00a0" +
         base::fixed_text(error, decimals);
}

std::string quantity_html(double value, double error, std::string_view unit) {
  if (std::isnan(value)) return "\u2013";
  const auto scales = scales_of(unit);
  // In what unit a plain zero is, nobody asks where the others choose their own.
  if (value == 0.0 && !(error > 0.0) && !scales.empty()) return "0";
  double factor = 1.0;
  std::string name(unit);
  if (!scales.empty() && std::isfinite(value)) {
    const double size = std::max(std::abs(value), std::max(error, 0.0));
    const Scale* best = &scales.front();
    for (const Scale& scale : scales) {
      best = &scale;
      if (size == 0.0 || size >= scale.factor) break;
    }
    factor = best->factor;
    name = best->unit;
  } else {
    for (const auto& [plain, raised] :
         {std::pair{"m3", "m\u00b3"}, std::pair{"m2", "m\u00b2"}, std::pair{"s2", "s\u00b2"}}) {
      for (auto at = name.find(plain); at != std::string::npos; at = name.find(plain)) {
        name.replace(at, 2, raised);
      }
    }
    name = escape_html(name);
  }
  if (name == "-" || name == "1") name.clear();
  std::string text = value_html(value / factor, error < 0.0 ? -1.0 : error / factor);
  if (name.empty()) return text;
  // "12.1 +- 0.3 mm" needs brackets only in front of a raised exponent, which brings its own.
  return text + "\u202f<span class=\"unit\">" + name + "</span>";
}

std::string duration_html(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "\u2013";
  if (seconds < 100.0) return number_html(seconds, 3) + "\u202fs";
  std::string text = base::duration_text(seconds);
  // A number and its unit stay together, the two of them may part.
  text.replace(text.rfind(' '), 1, k_narrow_space);
  text.replace(text.find(' '), 1, k_narrow_space);
  return text;
}

std::string percent_of_whole(double fraction) {
  return base::fixed_text(100.0 * std::clamp(fraction, 0.0, 1.0), 1);
}

std::string packed(std::span<const std::uint8_t> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> zipped(size);
  static const std::uint8_t k_none = 0;
  if (compress2(zipped.data(), &size, bytes.empty() ? &k_none : bytes.data(),
                static_cast<uLong>(bytes.size()), 6) != Z_OK) {
    throw std::runtime_error("no memory left to compress the pictures of the report");
  }
  static constexpr char k_digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((size + 2) / 3 * 4);
  for (std::size_t k = 0; k < size; k += 3) {
    const unsigned a = zipped[k];
    const unsigned b = k + 1 < size ? zipped[k + 1] : 0;
    const unsigned c = k + 2 < size ? zipped[k + 2] : 0;
    text += k_digits[a >> 2];
    text += k_digits[(a & 3) << 4 | b >> 4];
    text += k + 1 < size ? k_digits[(b & 15) << 2 | c >> 6] : '=';
    text += k + 2 < size ? k_digits[c & 63] : '=';
  }
  return text;
}

}  // namespace dust::io

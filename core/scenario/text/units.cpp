// SPDX-License-Identifier: Apache-2.0
#include "scenario/text/units.hpp"

#include "scenario/text/suggest.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

namespace dust::scenario {
namespace {

namespace dim = sdk::dimension;
using sdk::Dimension;

/// One row of the table of units.
struct Symbol {
  std::string_view name;
  double numerator;
  double denominator;
  Dimension dimension;
  bool takes_prefix;
};

/// The one table of units. Exact names are tried before a prefix is split off, so `min` is minutes
/// and `mm` millimetres.
constexpr std::array k_symbols = {
    Symbol{"m", 1, 1, dim::length, true},
    Symbol{"g", 1, 1000, dim::mass, true},
    Symbol{"t", 1000, 1, dim::mass, false},
    Symbol{"s", 1, 1, dim::time, true},
    Symbol{"min", 60, 1, dim::time, false},
    Symbol{"h", 3600, 1, dim::time, false},
    Symbol{"K", 1, 1, dim::temperature, true},
    Symbol{"rad", 1, 1, dim::angle, true},
    Symbol{"deg", std::numbers::pi, 180, dim::angle, false},
    Symbol{"\u00b0", std::numbers::pi, 180, dim::angle, false},
    Symbol{"rpm", std::numbers::pi, 30, dim::angular_velocity, false},
    Symbol{"Hz", 1, 1, dim::frequency, true},
    Symbol{"l", 1, 1000, dim::volume, true},
    Symbol{"L", 1, 1000, dim::volume, true},
    Symbol{"N", 1, 1, dim::force, true},
    Symbol{"Pa", 1, 1, dim::pressure, true},
    Symbol{"bar", 1e5, 1, dim::pressure, true},
    Symbol{"P", 1, 10, dim::dynamic_viscosity, true},
    Symbol{"J", 1, 1, dim::energy, true},
    Symbol{"W", 1, 1, dim::energy / dim::time, true},
    // Exact by definition: the international yard and pound of 1959.
    Symbol{"in", 254, 10000, dim::length, false},
    Symbol{"ft", 3048, 10000, dim::length, false},
    Symbol{"lb", 45359237, 1e8, dim::mass, false},
    Symbol{"cfm", 28316846592, 6e13, dim::volume_flow, false},
    Symbol{"fpm", 3048, 600000, dim::velocity, false},
    // Of metric tonnes, as everywhere here.
    Symbol{"tph", 1000, 3600, dim::mass_flow, false},
};

struct Prefix {
  std::string_view name;
  double numerator;
  double denominator;
};
constexpr std::array k_prefixes = {
    Prefix{"n", 1, 1e9}, Prefix{"u", 1, 1e6}, Prefix{"\u00b5", 1, 1e6}, Prefix{"\u03bc", 1, 1e6},
    Prefix{"m", 1, 1e3}, Prefix{"c", 1, 1e2}, Prefix{"d", 1, 10},       Prefix{"h", 1e2, 1},
    Prefix{"k", 1e3, 1}, Prefix{"M", 1e6, 1}, Prefix{"G", 1e9, 1},
};

/// Names of dimensions and the first units to offer, SI before others; the symbols of the table
/// that take no prefix follow by themselves.
struct Named {
  Dimension dimension;
  std::string_view name;
  std::string_view units;
};
constexpr std::array k_named = {
    Named{dim::length, "a length", "m, mm, um"},
    Named{dim::mass, "a mass", "kg, g, mg"},
    Named{dim::time, "a time", "s, ms, min"},
    Named{dim::temperature, "a temperature", "K, degC"},
    Named{dim::angle, "an angle", "rad, deg"},
    Named{dim::area, "an area", "m2, mm2"},
    Named{dim::volume, "a volume", "m3, l, ml"},
    Named{dim::frequency, "a frequency", "1/s, Hz, kHz"},
    Named{dim::velocity, "a velocity", "m/s, mm/s, m/min"},
    Named{dim::acceleration, "an acceleration", "m/s2, mm/s2"},
    Named{dim::angular_velocity, "an angular velocity", "rad/s, deg/s, rpm"},
    Named{dim::density, "a density", "kg/m3, g/cm3, t/m3"},
    Named{dim::force, "a force", "N, mN, uN"},
    Named{dim::pressure, "a pressure", "Pa, kPa, MPa, mbar"},
    Named{dim::dynamic_viscosity, "a dynamic viscosity", "Pa s, mPa s"},
    Named{dim::area / dim::time, "a kinematic viscosity", "m2/s, mm2/s"},
    Named{dim::mass_flow, "a mass flow", "kg/s, g/s, t/h"},
    Named{dim::volume_flow, "a volume flow", "m3/s, l/min, m3/h"},
    Named{dim::energy, "an energy", "J, mJ"},
    Named{dim::specific_energy, "an energy per mass", "J/kg, kJ/kg"},
    Named{dim::energy / dim::time, "a power", "W, mW"},
    Named{dim::stiffness, "a stiffness or surface energy", "N/m, J/m2, mJ/m2"},
};

const Named* find_named(Dimension d) {
  for (const Named& n : k_named) {
    if (n.dimension == d) return &n;
  }
  return nullptr;
}

std::optional<Unit> find_symbol(std::string_view name) {
  if (name == "%") return Unit{1, 100, dim::none, true};
  for (const Symbol& s : k_symbols) {
    if (s.name == name) return Unit{s.numerator, s.denominator, s.dimension};
  }
  for (const Prefix& p : k_prefixes) {
    if (!name.starts_with(p.name)) continue;
    for (const Symbol& s : k_symbols) {
      if (s.takes_prefix && s.name == name.substr(p.name.size())) {
        return Unit{p.numerator * s.numerator, p.denominator * s.denominator, s.dimension};
      }
    }
  }
  return std::nullopt;
}

Unit multiply(Unit a, const Unit& b, int exponent) {
  for (; exponent > 0; --exponent) {
    a.numerator *= b.numerator;
    a.denominator *= b.denominator;
    a.dimension = a.dimension * b.dimension;
  }
  for (; exponent < 0; ++exponent) {
    a.numerator *= b.denominator;
    a.denominator *= b.numerator;
    a.dimension = a.dimension / b.dimension;
  }
  a.is_share = a.is_share || b.is_share;
  return a;
}

/// Products and quotients from left to right; a blank multiplies, brackets group.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : rest_(text) {}
  std::optional<Unit> whole() {
    const auto unit = product(0);
    return unit && rest_.empty() ? unit : std::nullopt;
  }

 private:
  static constexpr int k_deepest = 8;

  void blanks() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  bool accept(std::string_view word) {
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  std::optional<Unit> product(int depth) {
    if (depth > k_deepest) return std::nullopt;
    Unit unit;
    int sign = 1;
    do {
      blanks();
      const auto next = factor(depth);
      if (!next) return std::nullopt;
      const auto power = exponent();
      if (!power) return std::nullopt;
      unit = multiply(unit, *next, sign * *power);
      blanks();
      if (rest_.empty() || rest_.front() == ')') return unit;
      sign = accept("/") ? -1 : 1;
      if (sign == 1 && !accept("*")) accept("\u00b7");
    } while (true);
  }
  std::optional<Unit> factor(int depth) {
    if (accept("(")) {
      auto inner = product(depth + 1);
      return inner && accept(")") ? inner : std::nullopt;
    }
    if (accept("1")) return Unit{};
    std::size_t n = 0;
    while (n < rest_.size() && (std::isalpha(static_cast<unsigned char>(rest_[n])) != 0 ||
                                rest_[n] == '%' || (rest_[n] & 0x80) != 0)) {
      // Raised 2 and 3 and the middle dot end a name; they share their first byte with the degree.
      const std::string_view two = rest_.substr(n, 2);
      if (two == "\u00b2" || two == "\u00b3" || two == "\u00b7") break;
      ++n;
    }
    const auto unit = find_symbol(rest_.substr(0, n));
    rest_.remove_prefix(n);
    return unit;
  }
  std::optional<int> exponent() {
    if (accept("\u00b2")) return 2;
    if (accept("\u00b3")) return 3;
    const bool is_marked = accept("^") || accept("**");
    const int sign = accept("-") ? -1 : 1;
    if (!rest_.empty() && std::isdigit(static_cast<unsigned char>(rest_.front())) != 0) {
      const int digit = rest_.front() - '0';
      rest_.remove_prefix(1);
      return sign * digit;
    }
    return is_marked || sign < 0 ? std::nullopt : std::optional<int>(1);
  }

  std::string_view rest_;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Length of the decimal number at the start of `text`; 0 if there is none.
std::size_t number_length(std::string_view text) {
  std::size_t n = 0;
  const auto digits = [&] {
    const std::size_t begin = n;
    while (n < text.size() && is_digit(text[n])) ++n;
    return n - begin;
  };
  if (n < text.size() && (text[n] == '-' || text[n] == '+')) ++n;
  std::size_t count = digits();
  if (n < text.size() && text[n] == '.') {
    ++n;
    count += digits();
  }
  if (count == 0) return 0;
  if (n < text.size() && (text[n] == 'e' || text[n] == 'E')) {
    const std::size_t mantissa = n++;
    if (n < text.size() && (text[n] == '-' || text[n] == '+')) ++n;
    if (digits() == 0) n = mantissa;
  }
  return n;
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) { return UnitParser(text).whole(); }

std::string si_unit(Dimension d) {
  if (d == dim::none) return {};
  if (const Named* n = find_named(d)) return std::string(n->units.substr(0, n->units.find(',')));
  std::string above;
  std::string below;
  const auto factor = [&](const char* symbol, int exponent) {
    std::string& side = exponent > 0 ? above : below;
    if (exponent == 0) return;
    if (!side.empty()) side += ' ';
    side.append(symbol);
    if (std::abs(exponent) > 1) side.append(std::to_string(std::abs(exponent)));
  };
  factor("kg", d.mass);
  factor("m", d.length);
  factor("s", d.time);
  factor("K", d.temperature);
  factor("rad", d.angle);
  if (above.empty()) above.push_back('1');
  if (below.empty()) return above;
  const bool is_product = below.find(' ') != std::string::npos;
  std::string unit = above;
  unit.append(is_product ? "/(" : "/").append(below).append(is_product ? ")" : "");
  return unit;
}

std::string dimension_name(Dimension d) {
  if (d == dim::none) return "a bare number";
  if (const Named* n = find_named(d)) return std::string(n->name);
  return "a quantity in " + si_unit(d);
}

std::string example_units(Dimension d) {
  const Named* n = find_named(d);
  std::string units = n != nullptr ? std::string(n->units) : si_unit(d);
  for (const Symbol& s : k_symbols) {
    const bool is_plain = static_cast<unsigned char>(s.name.front()) < 0x80;
    if (s.dimension != d || s.takes_prefix || !is_plain) continue;
    const bool is_there =
        (", " + units + ",").find(" " + std::string(s.name) + ",") != std::string::npos;
    if (!is_there) units.append(", ").append(s.name);
  }
  return units;
}

std::optional<WrittenNumber> split_number(std::string_view raw, std::string& error) {
  const std::string text = trimmed(raw);
  const auto fail = [&](std::string why) {
    error = std::move(why);
    return std::nullopt;
  };
  if (text.empty()) return fail("a number is expected, not an empty text");
  const std::size_t n = number_length(text);
  if (n == 0) return fail("a number is expected, not " + in_quotes(text));
  const std::string digits = text.substr(text[0] == '+' ? 1 : 0, n - (text[0] == '+' ? 1 : 0));
  const std::size_t lead = digits[0] == '-' ? 1 : 0;
  if (digits.size() > lead + 1 && digits[lead] == '0' && is_digit(digits[lead + 1])) {
    const std::size_t significant = digits.find_first_not_of('0', lead);
    // What is left without the zeros that lead, one of them kept before a point.
    std::string plain = significant == std::string::npos ? "" : digits.substr(significant);
    if (plain.empty() || !is_digit(plain.front())) plain.insert(0, 1, '0');
    if (lead == 1) plain.insert(0, 1, '-');
    return fail(in_quotes(text) +
                " could be read as an octal number: leave out the leading zero and " + "write " +
                plain);
  }
  WrittenNumber result;
  const auto [end, code] =
      std::from_chars(digits.data(), digits.data() + digits.size(), result.number);
  if (code == std::errc::result_out_of_range) {
    return fail(in_quotes(text) + " is too large or too small for a double");
  }
  if (code != std::errc{} || end != digits.data() + digits.size()) {
    return fail("a number is expected, not " + in_quotes(text));
  }
  result.unit = trimmed(std::string_view(text).substr(n));
  if (result.unit.empty()) return result;
  const char next = result.unit.front();
  if (next == ',' || next == '_' || next == ':' || next == '.') {
    return fail(in_quotes(text) + " is not a number: write it like 1234.5 (decimal point, " +
                "no separators)");
  }
  if (digits == "0" && (next == 'x' || next == 'o' || next == 'b') && result.unit.size() > 1 &&
      std::isxdigit(static_cast<unsigned char>(result.unit[1])) != 0) {
    return fail(in_quotes(text) + " is not a decimal number");
  }
  return result;
}

std::optional<double> to_si(const WrittenNumber& written, Dimension dimension, std::string& error) {
  if (written.unit.empty()) return written.number;
  // The one unit whose zero lies elsewhere: it stands alone and in no product.
  if (dimension == dim::temperature && (written.unit == "degC" || written.unit == "\u00b0C")) {
    constexpr double k_zero_celsius = 273.15;
    return written.number + k_zero_celsius;
  }
  const auto unit = parse_unit(written.unit);
  const std::string shown = printable(written.unit);
  if (!unit) {
    error = "unknown unit '" + shown + "': ";
    error += dimension == dim::none
                 ? "a bare number is expected, without a unit"
                 : dimension_name(dimension) + " is expected (" + example_units(dimension) + ")";
    return std::nullopt;
  }
  // A ratio of like quantities is a bare number: 3.6 g/t.
  const bool is_ratio = unit->dimension == dim::none && written.unit.find('/') != std::string::npos;
  if (dimension == dim::none && !unit->is_share && !is_ratio) {
    error = "'" + shown + "' does not belong here: a bare number is expected, without a unit";
    return std::nullopt;
  }
  if (!(unit->dimension == dimension)) {
    error = "'" + shown + "' is the unit of " + dimension_name(unit->dimension) + ": " +
            dimension_name(dimension) + " is expected (" + example_units(dimension) + ")";
    return std::nullopt;
  }
  const double value = written.number * unit->numerator / unit->denominator;
  if (!std::isfinite(value)) {
    error = "the value is too large for a double";
    return std::nullopt;
  }
  return value;
}

std::string number_text(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  // Plain digits where a person would write them.
  const double size = std::abs(value);
  const bool is_plain = value == 0.0 || (size >= 1e-4 && size < 1e7);
  std::array<char, 40> buffer{};
  const auto [end, code] = is_plain
                               ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                               std::chars_format::fixed)
                               : std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return code == std::errc{} ? std::string(buffer.data(), end) : std::string("0");
}

}  // namespace dust::scenario

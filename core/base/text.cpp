// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <span>
#include <string_view>

namespace dust::base {
namespace {

constexpr double k_minute = 60.0;
constexpr double k_hour = 3600.0;

struct Unit {
  double factor;  ///< in the SI unit
  std::string_view name;
};
// Largest first. Of masses and lengths alike a smaller unit than the last is none that people use.
constexpr std::array k_lengths = {Unit{1.0, "m"}, Unit{1e-3, "mm"}, Unit{1e-6, "um"}};
constexpr std::array k_masses = {Unit{1e3, "t"}, Unit{1.0, "kg"}, Unit{1e-3, "g"}, Unit{1e-6, "mg"},
                                 Unit{1e-9, "ug"}};
constexpr std::array k_mass_flows = {Unit{1.0, "kg/s"}, Unit{1e-3, "g/s"}, Unit{1e-6, "mg/s"},
                                     Unit{1e-9, "ug/s"}};

/// The unit that leaves at least one digit before the point; 0.9995 is written as 1.
const Unit& unit_for(double value, std::span<const Unit> units) {
  const double size = 1.0005 * std::abs(value);
  const auto* const unit = std::find_if(units.data(), units.data() + units.size(),
                                        [size](const Unit& u) { return size >= u.factor; });
  if (unit != units.data() + units.size()) return *unit;
  return value == 0.0 ? units.front() : units.back();
}

std::string text_in(const Unit& unit, double value, int digits) {
  return plain_text(value / unit.factor, digits) + " " + std::string(unit.name);
}

}  // namespace

std::string digits_text(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

std::string plain_text(double value, int digits) {
  if (std::isfinite(value) && std::abs(value) >= std::pow(10.0, digits) && std::abs(value) < 1e9) {
    return fixed_text(value, 0);
  }
  return digits_text(value, digits);
}

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
  // 98 s and 98 min, but 1.7 min and 1.7 h rather than "1e+02 s" and "1e+02 min".
  if (seconds < 99.0) return digits_text(std::max(seconds, 1.0), 2) + " s";
  if (seconds < 99.0 * k_minute) return digits_text(seconds / k_minute, 2) + " min";
  return digits_text(seconds / k_hour, seconds < 99.0 * k_hour ? 2 : 3) + " h";
}

std::string length_text(double metres, int digits) {
  return text_in(unit_for(metres, k_lengths), metres, digits);
}

std::string extent_text(const std::array<double, 3>& edges) {
  const double longest = std::max({edges[0], edges[1], edges[2]});
  // 1.2 m long are 1200 mm on a drawing: metres are for what people walk around in.
  const Unit& unit =
      longest < k_plant_extent && longest >= 1e-3 ? k_lengths[1] : unit_for(longest, k_lengths);
  constexpr int k_digits = 5;
  return digits_text(edges[0] / unit.factor, k_digits) + " x " +
         digits_text(edges[1] / unit.factor, k_digits) + " x " + text_in(unit, edges[2], k_digits);
}

std::string place_text(const sdk::Vec3& place, int digits) {
  return "(" + digits_text(place.x, digits) + ", " + digits_text(place.y, digits) + ", " +
         digits_text(place.z, digits) + ") m";
}

std::string area_text(double square_metres) {
  constexpr double k_square_centimetre = 1e-4;
  return square_metres >= 0.1 ? plain_text(square_metres, 4) + " m2"
                              : plain_text(square_metres / k_square_centimetre, 4) + " cm2";
}

std::string volume_text(double cubic_metres) {
  constexpr double k_cubic_centimetre = 1e-6;
  return std::abs(cubic_metres) >= 0.01 ? plain_text(cubic_metres, 4) + " m3"
                                        : plain_text(cubic_metres / k_cubic_centimetre, 4) + " cm3";
}

std::string mass_text(double kilograms, int digits) {
  const Unit& unit = kilograms == 0.0 ? k_masses[1] : unit_for(kilograms, k_masses);
  return text_in(unit, kilograms, digits);
}

std::string mass_flow_text(double kilograms_per_second, double extent, int digits) {
  const std::string in_si =
      text_in(unit_for(kilograms_per_second, k_mass_flows), kilograms_per_second, digits);
  constexpr double k_tonne_per_hour = 1e3 / k_hour;
  const double tonnes = kilograms_per_second / k_tonne_per_hour;
  if (!(extent >= k_plant_extent && std::abs(tonnes) >= 0.9995)) return in_si;
  return plain_text(tonnes, digits) + " t/h (" + in_si + ")";
}

std::string volume_flow_text(double cubic_metres_per_second, int digits) {
  const double per_hour = k_hour * cubic_metres_per_second;
  if (std::abs(per_hour) >= 1.0) return plain_text(per_hour, digits) + " m3/h";
  constexpr double k_litre = 1e-3;
  return plain_text(k_minute * cubic_metres_per_second / k_litre, digits) + " l/min";
}

}  // namespace dust::base

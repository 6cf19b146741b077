// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <array>
#include <string>

/// Numbers and durations as people read them: in messages, logs, tables and pages. What files keep
/// for machines is the shortest text that reads back as the same number.
namespace dust::base {

/// At most `digits` significant digits, without trailing zeros: "0.0123", "1.2e-07".
std::string digits_text(double value, int digits);
/// The same, with all digits before the point below 1e9: "4500", never "4.5e+03".
std::string plain_text(double value, int digits);
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

/// A domain whose longest edge [m] reaches this is spoken of as a plant: lengths in m, flows in
/// t/h.
inline constexpr double k_plant_extent = 2.0;

/// A length with three digits before the point at most: "1.2 m", "350 mm", "60 um".
std::string length_text(double metres, int digits = 4);
/// Three edges [m] in the one unit that suits the longest: "340 x 20 x 330 mm", "3.4 x 2.6 x 3 m".
std::string extent_text(const std::array<double, 3>& edges);
/// A place [m]: "(1.2, 0, -0.35) m".
std::string place_text(const sdk::Vec3& place, int digits = 4);
/// An area: "1.25 m2" from 1000 cm2 on.
std::string area_text(double square_metres);
/// A volume: "0.125 m3" from 10 litres on.
std::string volume_text(double cubic_metres);
/// A mass: "1.2 t", "3 kg", "150 g", "2 mg", "0.5 ug".
std::string mass_text(double kilograms, int digits = 3);
/// A mass flow: "2.5 kg/s", "6 g/s", "3 mg/s"; in a domain of a plant's `extent` [m] from 1 t/h on
/// as well as its engineers say it: "500 t/h (139 kg/s)".
std::string mass_flow_text(double kilograms_per_second, double extent, int digits = 3);
/// A flow of air: "4500 m3/h" from 1 m3/h on, "12 l/min" below.
std::string volume_flow_text(double cubic_metres_per_second, int digits = 4);

}  // namespace dust::base

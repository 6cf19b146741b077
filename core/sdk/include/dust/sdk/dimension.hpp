// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::sdk {

/// Exponents of the base quantities of a physical dimension. An angle is kept apart from a bare
/// number, so that `16 mm` where degrees are expected is an error.
struct Dimension {
  signed char length = 0;
  signed char mass = 0;
  signed char time = 0;
  signed char temperature = 0;
  signed char angle = 0;

  constexpr bool operator==(const Dimension&) const = default;
};

constexpr Dimension operator*(Dimension a, Dimension b) {
  return {static_cast<signed char>(a.length + b.length), static_cast<signed char>(a.mass + b.mass),
          static_cast<signed char>(a.time + b.time),
          static_cast<signed char>(a.temperature + b.temperature),
          static_cast<signed char>(a.angle + b.angle)};
}
constexpr Dimension operator/(Dimension a, Dimension b) {
  return {static_cast<signed char>(a.length - b.length), static_cast<signed char>(a.mass - b.mass),
          static_cast<signed char>(a.time - b.time),
          static_cast<signed char>(a.temperature - b.temperature),
          static_cast<signed char>(a.angle - b.angle)};
}

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{.length = 1};
inline constexpr Dimension mass{.mass = 1};
inline constexpr Dimension time{.time = 1};
inline constexpr Dimension temperature{.temperature = 1};
inline constexpr Dimension angle{.angle = 1};
inline constexpr Dimension area = length * length;
inline constexpr Dimension volume = area * length;
inline constexpr Dimension frequency = none / time;
inline constexpr Dimension velocity = length / time;
inline constexpr Dimension acceleration = velocity / time;
inline constexpr Dimension angular_velocity = angle / time;
inline constexpr Dimension density = mass / volume;
inline constexpr Dimension force = mass * acceleration;
inline constexpr Dimension pressure = force / area;
inline constexpr Dimension dynamic_viscosity = pressure * time;
inline constexpr Dimension mass_flow = mass / time;
inline constexpr Dimension volume_flow = volume / time;
inline constexpr Dimension energy = force * length;
inline constexpr Dimension surface_energy = energy / area;
inline constexpr Dimension specific_energy = energy / mass;
inline constexpr Dimension stiffness = force / length;
}  // namespace dimension

}  // namespace dust::sdk

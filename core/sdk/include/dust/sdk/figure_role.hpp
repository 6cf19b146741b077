// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/dimension.hpp"

#include <string_view>

/// What a figure of a sensor is, said by the sensor when it gives the figure. The report, studies
/// and comparisons read this and never a name.
namespace dust::sdk {

/// What a figure is there for.
enum class Role {
  detail,           ///< listed among the figures of its sensor, no more
  opening,          ///< what leaves the plant through an opening: the headline adds these up
  passage,          ///< what passes a place inside
  stock,            ///< what a region holds
  stream_quantile,  ///< how far a falling stream has come: FigureRole::probability, ::drop
  low_pressure,     ///< a place of low mean pressure: FigureRole::index tells several apart
  balance,          ///< part of a balance of something conserved
  observed_time,    ///< how long the other figures of the sensor have been observed
};

/// What a figure measures. It fixes the dimension of the unit.
enum class Quantity {
  unspecified,
  mass,
  number,
  mass_rate,
  number_rate,
  mass_per_load,  ///< mass per mass released, in g/t
  mass_concentration,
  number_concentration,
  ratio,
  x,
  y,
  z,
  length,
  time,
  velocity,
  angle,
  energy,
  power,
  force,
  torque,
  pressure,            ///< stresses as well
  depth_of_pressure,   ///< how far the pressure lies below zero
  kinematic_pressure,  ///< pressure over density
  granular_temperature,
  angular_velocity,  ///< in rad/s
  vorticity,         ///< in 1/s
  volume,
  volume_rate,
  mass_per_length,  ///< load of a belt
  rate,             ///< anything else per time, in 1/s
};

/// Of what passes a place.
enum class Direction { none, forward, backward, net };

/// What a figure is, beyond its name, value and unit. The defaults say: a detail.
struct FigureRole {
  Role role = Role::detail;
  Quantity quantity = Quantity::unspecified;
  Direction direction = Direction::none;
  double smallest = 0.0;          ///< [m] diameters counted; the same twice: one size class
  double largest = 0.0;           ///< [m] 0 = no limit
  std::string_view species = {};  ///< the material counted; "" = all
  std::string_view towards = {};  ///< the total it is a part of, e.g. "emission"; "" = none
  double probability = 0.0;       ///< [-] of a quantile
  double drop = 0.0;              ///< [m] below the start of the stream
  int index = 0;                  ///< from 1 on, where a sensor gives several of a kind

  [[nodiscard]] constexpr FigureRole of(Quantity q) const {
    FigureRole role_of_q = *this;
    role_of_q.quantity = q;
    return role_of_q;
  }
  [[nodiscard]] constexpr FigureRole sizes(double from, double to) const {
    FigureRole sized = *this;
    sized.smallest = from;
    sized.largest = to;
    return sized;
  }
};

/// A detail of a quantity: what most figures are.
constexpr FigureRole detail(Quantity quantity) { return FigureRole{}.of(quantity); }

constexpr std::string_view name_of(Role role) {
  constexpr std::string_view names[] = {"detail",  "opening",         "passage",
                                        "stock",   "stream_quantile", "low_pressure",
                                        "balance", "observed_time"};
  return names[static_cast<int>(role)];
}

constexpr std::string_view name_of(Direction direction) {
  constexpr std::string_view names[] = {"none", "forward", "backward", "net"};
  return names[static_cast<int>(direction)];
}

/// The name of a quantity in files, and the dimension of its unit.
struct QuantityInfo {
  std::string_view name;
  Dimension dimension;
};
constexpr QuantityInfo info_of(Quantity quantity) {
  namespace d = dimension;
  constexpr QuantityInfo infos[] = {{"", d::none},
                                    {"mass", d::mass},
                                    {"number", d::none},
                                    {"mass_rate", d::mass_flow},
                                    {"number_rate", d::frequency},
                                    {"mass_per_load", d::none},
                                    {"mass_concentration", d::density},
                                    {"number_concentration", d::none / d::volume},
                                    {"ratio", d::none},
                                    {"x", d::length},
                                    {"y", d::length},
                                    {"z", d::length},
                                    {"length", d::length},
                                    {"time", d::time},
                                    {"velocity", d::velocity},
                                    {"angle", d::angle},
                                    {"energy", d::energy},
                                    {"power", d::energy / d::time},
                                    {"force", d::force},
                                    {"torque", d::energy},
                                    {"pressure", d::pressure},
                                    {"depth_of_pressure", d::pressure},
                                    {"kinematic_pressure", d::velocity * d::velocity},
                                    {"granular_temperature", d::velocity * d::velocity},
                                    {"angular_velocity", d::angular_velocity},
                                    {"vorticity", d::frequency},
                                    {"volume", d::volume},
                                    {"volume_rate", d::volume / d::time},
                                    {"mass_per_length", d::mass / d::length},
                                    {"rate", d::frequency}};
  return infos[static_cast<int>(quantity)];
}

}  // namespace dust::sdk

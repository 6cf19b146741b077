// SPDX-License-Identifier: Apache-2.0
#include "report/facts/stream_document.hpp"

#include "report/facts/flight.hpp"

#include <algorithm>

namespace dust::report {

namespace {

using nlohmann::json;

/// Paths of single grains in still air, of the finest and the coarsest coarse class.
json isolated_json(const json& report, const DustSizes& dust, double speed, double gravity,
                   double deepest) {
  const json& setting = object_at(report, "setting");
  const auto air_density = number_at(object_at(setting, "fluid"), "density");
  const auto viscosity = number_at(object_at(setting, "fluid"), "viscosity");
  double density = 0.0;
  for (const json& emitter : list_at(setting, "emitters")) {
    const double own = number_at(emitter, "density").value_or(0.0);
    // Which grains are whose is not told; coarse ones fly as those they stand for.
    if ((density != 0.0 && own != density) || emitter.contains("stands_for")) return json::array();
    density = own;
  }
  std::vector<double> sizes;
  for (const json& diameter : list_at(report, "classes")) {
    if (diameter.is_number() && !dust.is_dust(diameter.get<double>())) sizes.push_back(diameter);
  }
  json list = json::array();
  if (!air_density || !viscosity || !(density > 0.0) || sizes.empty()) return list;
  std::sort(sizes.begin(), sizes.end());
  if (sizes.size() > 2) sizes = {sizes.front(), sizes.back()};
  constexpr int k_points = 40;
  std::vector<double> drops;
  // Closer together at the start, where the path is level.
  for (int k = 0; k <= k_points; ++k) drops.push_back(deepest * (k * k) / (k_points * k_points));
  for (const double size : sizes) {
    const auto places =
        isolated_flight({size, density, speed}, {*air_density, *viscosity}, gravity, drops);
    if (places.empty()) continue;
    list.push_back({{"diameter", size}, {"x", places}, {"drop", drops}});
  }
  return list;
}

}  // namespace

json stream_json(const Highlights& highlights) {
  json list = json::array();
  const auto part = [](const Figure& figure) -> json {
    if (figure.name.empty()) return nullptr;
    return {{"value", figure.value}, {"error", figure.uncertainty}};
  };
  for (const StreamDrop& drop : highlights.stream) {
    list.push_back({{"drop", drop.drop},
                    {"low", part(drop.low)},
                    {"median", part(drop.median)},
                    {"high", part(drop.high)}});
  }
  return list;
}

/// Only for belts so fast that grains leave at the top of the pulley, v^2 >= g R: from slower ones
/// they slide off farther round, and no closed form without friction tells where.
json flights_json(const json& report, const DustSizes& dust, double deepest) {
  const json& setting = object_at(report, "setting");
  const json& gravity = list_at(setting, "gravity");
  json list = json::array();
  const bool is_down = gravity.size() == 3 && gravity[0] == 0.0 && gravity[1] == 0.0 &&
                       gravity[2].is_number() && gravity[2] < 0.0;
  if (!is_down) return list;
  for (const json& belt : list_at(setting, "belts")) {
    const auto speed = number_at(belt, "speed");
    const double fall = -gravity[2].get<double>();
    const double radius = number_at(belt, "radius").value_or(0.0);
    if (speed && *speed > 0.0 && *speed * *speed >= fall * radius) {
      list.push_back({{"name", text_at(belt, "name")},
                      {"speed", *speed},
                      {"gravity", fall},
                      {"lone", isolated_json(report, dust, *speed, fall, deepest)}});
    }
  }
  return list;
}

}  // namespace dust::report

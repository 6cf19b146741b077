// SPDX-License-Identifier: Apache-2.0
#include "report/facts/stream_document.hpp"

#include "dust/sdk/vec3.hpp"
#include "report/facts/flight.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace dust::report {

namespace {

using nlohmann::json;
using sdk::Vec3;

/// A belt that a stream leaves.
struct Belt {
  std::string name;
  double speed = 0.0;        ///< [m/s]
  double radius = 0.0;       ///< [m] of the belt round the pulley; 0: not known
  std::optional<Vec3> head;  ///< [m] middle of the pulley
};

std::optional<Vec3> vector_at(const json& object, const char* key) {
  const json& list = list_at(object, key);
  if (list.size() != 3) return std::nullopt;
  Vec3 v;
  for (int d = 0; d < 3; ++d) {
    if (!list[static_cast<std::size_t>(d)].is_number()) return std::nullopt;
    v[d] = list[static_cast<std::size_t>(d)].get<double>();
  }
  return v;
}

/// Where the sensor of the stream counts its drops from.
std::optional<Vec3> start_of(const json& setting, const std::vector<StreamDrop>& stream) {
  for (const json& sensor : list_at(setting, "sensors")) {
    if (!stream.empty() && text_at(sensor, "name") == stream.front().median.sensor) {
      return vector_at(sensor, "at");
    }
  }
  return std::nullopt;
}

/// Of belts whose head is known the nearest to the start of the stream; all where one's is not.
std::vector<Belt> belts_of(const json& setting, const std::optional<Vec3>& start) {
  std::vector<Belt> belts;
  for (const json& belt : list_at(setting, "belts")) {
    const auto speed = number_at(belt, "speed");
    if (!speed || !(*speed > 0.0)) continue;
    belts.push_back({text_at(belt, "name"), *speed, number_at(belt, "radius").value_or(0.0),
                     vector_at(belt, "head")});
  }
  const bool are_known = start && std::all_of(belts.begin(), belts.end(),
                                              [](const Belt& b) { return b.head.has_value(); });
  if (!are_known || belts.empty()) return belts;
  return {*std::min_element(belts.begin(), belts.end(), [&](const Belt& a, const Belt& b) {
    return norm(*a.head - *start) < norm(*b.head - *start);
  })};
}

/// The finest and the coarsest coarse class [m], one where there is but one.
std::vector<double> end_sizes(const json& report, const DustSizes& dust) {
  std::vector<double> sizes;
  for (const json& diameter : list_at(report, "classes")) {
    if (diameter.is_number() && !dust.is_dust(diameter.get<double>())) sizes.push_back(diameter);
  }
  std::sort(sizes.begin(), sizes.end());
  if (sizes.size() > 2) sizes = {sizes.front(), sizes.back()};
  return sizes;
}

/// The density of all grains [kg/m3]; 0 where it is not one.
double density_of(const json& setting) {
  double density = 0.0;
  for (const json& emitter : list_at(setting, "emitters")) {
    const double own = number_at(emitter, "density").value_or(0.0);
    // Which grains are whose is not told; coarse ones fly as those they stand for.
    if ((density != 0.0 && own != density) || emitter.contains("stands_for")) return 0.0;
    density = own;
  }
  return density;
}

/// What one belt's grains do alone.
class Flights {
 public:
  Flights(const json& report, const DustSizes& dust, const Belt& belt,
          const std::optional<Vec3>& start, double gravity, double deepest)
      : setting_(object_at(report, "setting")), belt_(belt), gravity_(gravity), deepest_(deepest) {
    if (start && belt.head) top_ = belt.head->z + belt.radius - start->z;
    for (const double size : end_sizes(report, dust)) {
      // Slower ones slide off farther round, and no closed form without friction tells where.
      if (belt.speed * belt.speed >= gravity * (belt.radius + 0.5 * size)) sizes_.push_back(size);
    }
  }

  /// Two sizes where that makes a difference to be seen.
  [[nodiscard]] json in_vacuum() const {
    constexpr double k_seen = 0.01;
    json list = json::array();
    for (const double size : sizes_) {
      const bool is_alike = !list.empty() && 0.5 * (size - sizes_.front()) < k_seen * deepest_;
      if (!is_alike) list.push_back({{"diameter", size}, {"start", start_of(size)}});
    }
    return list;
  }

  /// Paths in still air.
  [[nodiscard]] json in_still_air() const {
    const auto density = number_at(object_at(setting_, "fluid"), "density");
    const auto viscosity = number_at(object_at(setting_, "fluid"), "viscosity");
    const double of_grains = density_of(setting_);
    json list = json::array();
    if (!density || !viscosity || !(of_grains > 0.0)) return list;
    for (const double size : sizes_) {
      constexpr int k_points = 40;
      std::vector<double> drops, falls;
      // Closer together at the start, where the path is level.
      for (int k = 0; k <= k_points; ++k) {
        drops.push_back(deepest_ * (k * k) / (k_points * k_points));
        falls.push_back(std::max(0.0, drops.back() + start_of(size)));
      }
      const auto places =
          isolated_flight({size, of_grains, belt_.speed}, {*density, *viscosity}, gravity_, falls);
      if (places.empty()) continue;
      list.push_back({{"diameter", size}, {"x", places}, {"drop", drops}});
    }
    return list;
  }

  [[nodiscard]] bool are_none() const { return sizes_.empty(); }

 private:
  /// [m] over the start of the stream
  [[nodiscard]] double start_of(double size) const { return top_ + 0.5 * size; }

  const json& setting_;
  const Belt& belt_;
  double gravity_, deepest_;
  double top_ = 0.0;           ///< [m] of the belt over the start of the stream
  std::vector<double> sizes_;  ///< [m] that leave at the top
};

}  // namespace

json stream_json(const Highlights& highlights) {
  json list = json::array();
  const auto part = [](const Figure& figure) -> json {
    if (figure.name.empty()) return nullptr;
    return {{"value", figure.value}, {"error", figure.uncertainty}};
  };
  for (const StreamDrop& drop : highlights.stream) {
    list.push_back({{"sensor", drop.median.sensor},
                    {"drop", drop.drop},
                    {"low", part(drop.low)},
                    {"median", part(drop.median)},
                    {"high", part(drop.high)}});
  }
  return list;
}

json flights_json(const json& report, const DustSizes& dust,
                  const std::vector<StreamDrop>& stream) {
  const json& setting = object_at(report, "setting");
  const json& gravity = list_at(setting, "gravity");
  json list = json::array();
  const bool is_down = gravity.size() == 3 && gravity[0] == 0.0 && gravity[1] == 0.0 &&
                       gravity[2].is_number() && gravity[2] < 0.0;
  if (!is_down) return list;
  const double fall = -gravity[2].get<double>();
  const auto start = start_of(setting, stream);
  for (const Belt& belt : belts_of(setting, start)) {
    const Flights flights(report, dust, belt, start, fall,
                          stream.empty() ? 0.0 : stream.back().drop);
    if (flights.are_none()) continue;
    list.push_back({{"name", belt.name},
                    {"speed", belt.speed},
                    {"gravity", fall},
                    {"free", flights.in_vacuum()},
                    {"lone", flights.in_still_air()}});
  }
  return list;
}

}  // namespace dust::report

// SPDX-License-Identifier: Apache-2.0
#include "report/blob.hpp"
#include "report/pictures/colour_code.hpp"
#include "report/pictures/pictures.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dust::report {

namespace {

using nlohmann::json;

/// A field of a sensor on its own grid, x fastest.
struct SensorGrid {
  std::array<double, 3> origin{}, spacing{};  ///< [m]
  std::array<std::size_t, 3> count{};
  std::vector<float> values;
};

/// What is seen of it along an axis: the largest value on each line of sight.
struct Sight {
  std::size_t along = 0;
  std::size_t right = 0, up = 0;  ///< the axes of the picture
  std::vector<double> largest;    ///< rows along `right`
  std::size_t seen = 0;           ///< lines of sight that meet something
};

std::optional<SensorGrid> read_sensor_grid(const H5Source& source, const std::string& path) {
  const auto origin = source.attribute(path, "origin");
  const auto spacing = source.attribute(path, "spacing");
  const auto shape = source.shape(path);
  if (origin.size() != 3 || spacing.size() != 3 || shape.size() != 3) return std::nullopt;
  SensorGrid field;
  for (std::size_t d = 0; d < 3; ++d) {
    field.origin[d] = origin[d];
    field.spacing[d] = spacing[d];
    field.count[d] = shape[2 - d];
  }
  field.values = source.floats(path);
  if (field.values.size() != shape[0] * shape[1] * shape[2]) return std::nullopt;
  return field;
}

Sight look_along(const SensorGrid& field, std::size_t along) {
  Sight sight;
  sight.along = along;
  sight.right = along == 0 ? 1 : 0;
  sight.up = along == 2 ? 1 : 2;
  const auto& n = field.count;
  sight.largest.assign(n[sight.right] * n[sight.up], 0.0);
  std::array<std::size_t, 3> at{};
  for (const float value : field.values) {
    double& best = sight.largest[at[sight.up] * n[sight.right] + at[sight.right]];
    best = std::max(best, static_cast<double>(value));
    for (std::size_t d = 0; d < 3 && ++at[d] == n[d]; ++d) at[d] = 0;
  }
  sight.seen = static_cast<std::size_t>(
      std::count_if(sight.largest.begin(), sight.largest.end(), [](double v) { return v > 0.0; }));
  return sight;
}

/// Along the axis that shows most of the surface; from the side where others show no more.
Sight best_sight(const SensorGrid& field) {
  Sight best = look_along(field, 1);
  for (const std::size_t along : {std::size_t{2}, std::size_t{0}}) {
    Sight other = look_along(field, along);
    if (other.seen > best.seen) best = std::move(other);
  }
  return best;
}

json sensor_map_of(const SensorGrid& field) {
  const Sight sight = best_sight(field);
  if (sight.seen == 0) return nullptr;
  const double most = *std::max_element(sight.largest.begin(), sight.largest.end());
  std::vector<std::uint8_t> codes;
  for (const double value : sight.largest) {
    codes.push_back(value > 0.0 ? colour_code(place_on_scale(value, most)) : std::uint8_t{0});
  }
  constexpr const char* k_axes[] = {"x", "y", "z"};
  return {{"along", k_axes[sight.along]},
          {"axes", {k_axes[sight.right], k_axes[sight.up]}},
          {"nx", field.count[sight.right]},
          {"nz", field.count[sight.up]},
          {"x0", field.origin[sight.right]},
          {"z0", field.origin[sight.up]},
          {"dx", field.spacing[sight.right]},
          {"dz", field.spacing[sight.up]},
          {"decades", k_decades},
          {"most", most},
          {"data", packed(codes)}};
}

}  // namespace

json sensor_maps_of(const H5Source& source) {
  json maps = json::array();
  const auto frames = source.frames("/sensors");
  if (frames.empty()) return maps;
  const std::string last = "/sensors/" + frames.back();
  for (const std::string& sensor : source.members(last)) {
    for (const std::string& name : source.members(last + "/" + sensor)) {
      const std::string path = last + "/" + sensor + "/" + name;
      const auto field = read_sensor_grid(source, path);
      if (!field) continue;
      json map = sensor_map_of(*field);
      if (map.is_null()) continue;
      map["sensor"] = sensor;
      map["name"] = name;
      map["unit"] = source.text(path, "units");
      maps.push_back(std::move(map));
    }
  }
  return maps;
}

}  // namespace dust::report

// SPDX-License-Identifier: Apache-2.0
#include "report/blob.hpp"
#include "report/pictures/colour_code.hpp"
#include "report/pictures/pictures.hpp"

#include <algorithm>
#include <cmath>

namespace dust::report {

namespace {

using nlohmann::json;

constexpr double k_longer_side = 120.0;  ///< cells of the map

}  // namespace

DustMap dust_map_of(const H5Source& source, const View& view, const DustSizes& dust,
                    std::vector<DustPlace>& places) {
  DustMap map;
  const auto names = source.frames("/particles");
  if (names.empty() || view.is_empty()) return map;
  std::vector<double> times;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto time = source.attribute("/particles/" + names[k], "time");
    times.push_back(time.empty() ? static_cast<double>(k) : time[0]);
  }
  const double width = view.max_x - view.min_x, height = view.max_z - view.min_z;
  map.cell = std::max(width, height) / k_longer_side;
  map.nx = static_cast<std::size_t>(std::ceil(width / map.cell));
  map.nz = static_cast<std::size_t>(std::ceil(height / map.cell));
  map.share.assign(map.nx * map.nz, 0.0);
  double all = 0.0;
  for (std::size_t f = 0; f < names.size(); ++f) {
    if (times[f] < 0.5 * times.back()) continue;
    const std::string path = "/particles/" + names[f];
    const auto position = source.floats(path + "/position");
    const auto diameter = source.floats(path + "/diameter");
    const auto weight = source.floats(path + "/weight");
    for (std::size_t k = 0; 3 * k + 2 < position.size() && k < diameter.size(); ++k) {
      if (!dust.is_dust(diameter[k])) continue;
      const double x = position[3 * k], y = position[3 * k + 1], z = position[3 * k + 2];
      if (!(x >= view.min_x && x <= view.max_x && z >= view.min_z && z <= view.max_z)) continue;
      // Shares need no density as long as dust is of one material.
      const double mass = (k < weight.size() ? weight[k] : 1.0) * std::pow(diameter[k], 3);
      const auto column =
          std::min(map.nx - 1, static_cast<std::size_t>((x - view.min_x) / map.cell));
      const auto row = std::min(map.nz - 1, static_cast<std::size_t>((z - view.min_z) / map.cell));
      map.share[row * map.nx + column] += mass;
      for (DustPlace& place : places) {
        const double depth = place.y ? y - *place.y : 0.0;
        if (std::hypot(x - place.x, depth, z - place.z) <= place.reach) place.share += mass;
      }
      all += mass;
    }
  }
  if (!(all > 0.0)) return {};
  for (double& share : map.share) share /= all;
  for (DustPlace& place : places) place.share /= all;
  return map;
}

json dust_map_json(const DustMap& map, const View& view) {
  if (map.share.empty()) return nullptr;
  const double most = *std::max_element(map.share.begin(), map.share.end());
  std::vector<std::uint8_t> codes;
  for (const double share : map.share) {
    codes.push_back(share > 0.0 ? colour_code(place_on_scale(share, most)) : std::uint8_t{0});
  }
  return {{"nx", map.nx},         {"nz", map.nz},
          {"x0", view.min_x},     {"z0", view.min_z},
          {"cell", map.cell},     {"most", most * k_square_centimetre / (map.cell * map.cell)},
          {"decades", k_decades}, {"data", packed(codes)}};
}

}  // namespace dust::report

// SPDX-License-Identifier: Apache-2.0
#include "report/blob.hpp"
#include "report/fluid_grid.hpp"
#include "report/pictures/colour_code.hpp"
#include "report/pictures/pictures.hpp"

#include <algorithm>
#include <numeric>

namespace dust::report {

namespace {

using nlohmann::json;

/// Kinds of causes, as the run names its fields, and as the page does.
constexpr const char* k_kinds[][2] = {{"walls", "by walls and bodies"},
                                      {"grains", "by grains among themselves"},
                                      {"wind", "by the wind"}};

/// Sums over the depth, z rows of x; empty where the frame has no such field.
std::vector<double> seen_from_the_side(const H5Source& source, const std::string& path,
                                       const FluidGrid& grid) {
  const auto& n = grid.count;
  const auto values = source.floats(path);
  if (values.size() != n[0] * n[1] * n[2]) return {};
  std::vector<double> sums(n[0] * n[2], 0.0);
  for (std::size_t k = 0; k < n[2]; ++k) {
    for (std::size_t j = 0; j < n[1]; ++j) {
      for (std::size_t i = 0; i < n[0]; ++i) {
        sums[k * n[0] + i] += values[(k * n[1] + j) * n[0] + i];
      }
    }
  }
  return sums;
}

std::string release_codes(const std::vector<double>& sums, double most) {
  std::vector<std::uint8_t> codes;
  for (const double sum : sums) {
    codes.push_back(sum > 0.0 ? colour_code(place_on_scale(sum, most)) : std::uint8_t{0});
  }
  return packed(codes);
}

}  // namespace

json release_map_of(const H5Source& source) {
  const auto frames = source.frames("/fluid");
  const auto grid = fluid_grid_of(source);
  if (frames.empty() || !grid) return nullptr;
  std::vector<std::pair<const char*, std::vector<double>>> maps;
  double most = 0.0;
  for (const auto& [name, title] : k_kinds) {
    auto sums =
        seen_from_the_side(source, "/fluid/" + frames.back() + "/dust_set_free_by_" + name, *grid);
    const double largest = sums.empty() ? 0.0 : *std::max_element(sums.begin(), sums.end());
    if (!(largest > 0.0)) continue;
    most = std::max(most, largest);
    maps.emplace_back(title, std::move(sums));
  }
  if (maps.empty()) return nullptr;
  json kinds = json::array();
  for (const auto& [title, sums] : maps) {
    kinds.push_back({{"title", title},
                     {"kg", std::accumulate(sums.begin(), sums.end(), 0.0)},
                     {"data", release_codes(sums, most)}});
  }
  const double area = grid->spacing[0] * grid->spacing[2];
  return {{"nx", grid->count[0]},   {"nz", grid->count[2]},
          {"x0", grid->origin[0]},  {"z0", grid->origin[2]},
          {"dx", grid->spacing[0]}, {"dz", grid->spacing[2]},
          {"decades", k_decades},   {"most", most * k_square_centimetre / area},
          {"kinds", kinds}};
}

}  // namespace dust::report

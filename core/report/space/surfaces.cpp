// SPDX-License-Identifier: Apache-2.0
#include "report/blob.hpp"
#include "report/space/space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace dust::report {

namespace {

using nlohmann::json;
using Code = std::array<std::uint16_t, 3>;

constexpr std::size_t k_surface_frames = 60;  ///< of bodies that move
constexpr std::size_t k_triangles_of_set = 40000;
constexpr std::size_t k_all_triangles = 400000;  ///< of all sets: 9 bytes each before compression
constexpr double k_coordinate_codes = 65535.0;

/// Triangles of a frame as they are in the file.
Surfaces read(const H5Source& source, const std::string& frame) {
  const std::string path = "/walls/" + frame;
  return {source.floats(path + "/points"), source.integers(path + "/triangles"),
          source.integers(path + "/body")};
}

/// Triangles with corners in 16 bits, body by body.
struct Coded {
  std::vector<Code> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::int64_t, 3>> bodies;  ///< body, first triangle, count
};

/// Corners that fall on the same point of a lattice of `step` codes become one: triangles without
/// area go. A step of 1 is all that 16 bits can tell.
Coded coded(const Surfaces& surfaces, const Box& box, unsigned step) {
  std::vector<std::uint32_t> place(surfaces.points.size() / 3);
  std::map<Code, std::uint32_t> known;
  Coded result;
  for (std::size_t k = 0; k < place.size(); ++k) {
    Code code{};
    for (std::size_t d = 0; d < 3; ++d) {
      const double share = (surfaces.points[3 * k + d] - box.min[d]) / (box.max[d] - box.min[d]);
      const double lattice =
          std::round(std::clamp(share, 0.0, 1.0) * k_coordinate_codes / step) * step;
      code[d] = static_cast<std::uint16_t>(std::min(lattice, k_coordinate_codes));
    }
    const auto [at, is_new] =
        known.try_emplace(code, static_cast<std::uint32_t>(result.points.size()));
    if (is_new) result.points.push_back(code);
    place[k] = at->second;
  }
  for (std::size_t k = 0; k < surfaces.body.size(); ++k) {
    std::array<std::uint32_t, 3> corner{};
    for (std::size_t c = 0; c < 3; ++c) {
      corner[c] = place[static_cast<std::size_t>(surfaces.corners[3 * k + c])];
    }
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    if (result.bodies.empty() || result.bodies.back()[0] != surfaces.body[k]) {
      result.bodies.push_back(
          {surfaces.body[k], static_cast<std::int64_t>(result.triangles.size()), 0});
    }
    result.triangles.push_back(corner);
    ++result.bodies.back()[2];
  }
  return result;
}

/// As fine as a page holds.
Coded fitted(const Surfaces& surfaces, const Box& box, bool& is_coarsened) {
  unsigned step = 1;
  Coded set = coded(surfaces, box, step);
  while (set.triangles.size() > k_triangles_of_set && step < 4096) {
    step *= 2;
    set = coded(surfaces, box, step);
  }
  is_coarsened = is_coarsened || step > 1;
  return set;
}

void put(std::vector<std::uint8_t>& bytes, std::uint32_t value, int width) {
  for (int k = 0; k < width; ++k) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * k)));
}

/// Corners first, coordinate by coordinate, then the triangles: four bytes each.
json packed_set(const Coded& set) {
  std::vector<std::uint8_t> bytes;
  for (const auto& triangle : set.triangles) {
    for (const std::uint32_t corner : triangle) put(bytes, corner, 4);
  }
  for (std::size_t d = 0; d < 3; ++d) {
    for (const Code& point : set.points) put(bytes, point[d], 2);
  }
  return {{"points", set.points.size()},
          {"triangles", set.triangles.size()},
          {"bodies", set.bodies},
          {"data", packed(bytes)}};
}

}  // namespace

bool Surfaces::is_whole() const {
  const auto count = static_cast<std::int64_t>(points.size() / 3);
  return corners.size() == 3 * body.size() &&
         std::all_of(corners.begin(), corners.end(),
                     [&](std::int64_t c) { return c >= 0 && c < count; });
}

json surfaces_json(const std::vector<std::string>& names, const Surfaces& surfaces,
                   const Box& box) {
  if (surfaces.body.empty()) return nullptr;
  bool is_coarsened = false;
  const json set = packed_set(fitted(clipped(surfaces, box), box, is_coarsened));
  return {{"names", names},
          {"sets", json::array({set})},
          {"times", json::array({0.0})},
          {"shown", json::array({0})},
          {"coarsened", is_coarsened}};
}

json surfaces_of(const H5Source& source, const Box& box) {
  const auto names = source.frames("/walls");
  if (names.empty()) return nullptr;
  json sets = json::array(), times = json::array(), shown = json::array();
  Surfaces last;
  std::size_t all = 0;
  bool is_coarsened = false;
  for (const std::size_t k : spread_frames(names.size(), k_surface_frames)) {
    Surfaces now = read(source, names[k]);
    if (!now.is_whole()) continue;
    if (sets.empty() || !(now == last)) {
      const Coded set = fitted(clipped(now, box), box, is_coarsened);
      all += set.triangles.size();
      if (!sets.empty() && all > k_all_triangles) break;  // what is there stays
      sets.push_back(packed_set(set));
      last = std::move(now);
    }
    const auto time = source.attribute("/particles/" + names[k], "time");
    times.push_back(time.empty() ? static_cast<double>(k) : time[0]);
    shown.push_back(sets.size() - 1);
  }
  if (sets.empty()) return nullptr;
  return {{"names", source.texts("/walls", "names")},
          {"sets", std::move(sets)},
          {"times", std::move(times)},
          {"shown", std::move(shown)},
          {"coarsened", is_coarsened}};
}

}  // namespace dust::report

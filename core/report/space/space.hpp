// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/h5_source.hpp"
#include "report/pictures/pictures.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace dust::report {

/// Triangles of bodies: coordinates of corners [m], three corners of each triangle, whose it is.
struct Surfaces {
  std::vector<float> points;
  std::vector<std::int64_t> corners, body;

  [[nodiscard]] bool is_whole() const;
  bool operator==(const Surfaces&) const = default;
};

/// What of the surfaces lies in the box; triangles that cross its sides are cut there.
[[nodiscard]] Surfaces clipped(const Surfaces& surfaces, const Box& box);

/// What the page needs beyond the grains to show a run in three dimensions: {"min", "max",
/// "is_thin", "surfaces", "air", "dust"}; null where nothing is known of the space.
/// `dust_classes`: the names of the classes of airborne dust.
[[nodiscard]] nlohmann::json space_of(const H5Source& source, const Box& box,
                                      const std::vector<std::string>& dust_classes);

/// The surfaces of the bodies: {"names", "sets": [{"points", "triangles", "bodies": [[body, first,
/// count], ..], "data"}], "times", "shown": [set of each time], "coarsened"}. Corners have 16 bits
/// in `box`. A set of surfaces that stays from frame to frame is stored once; where bodies move,
/// each of at most 60 frames has its own. Surfaces of more triangles than a page holds are
/// coarsened by joining near corners. Null without surfaces.
[[nodiscard]] nlohmann::json surfaces_of(const H5Source& source, const Box& box);

/// The same of bodies that stand where `surfaces` says, `names` in their order.
[[nodiscard]] nlohmann::json surfaces_json(const std::vector<std::string>& names,
                                           const Surfaces& surfaces, const Box& box);

/// The velocity of the air in blocks of cells, 8 bits per component (stored by the root, as in the
/// maps), 255 inside bodies; null without fluid. In a thin domain the maps of the side view tell
/// the same, so that there is none.
[[nodiscard]] nlohmann::json air_field_of(const H5Source& source);

/// Airborne dust of all `classes` in the blocks of `air`, and where it came off the grains until
/// the last frame: {"frames": [{"t", "data"}], "most", "decades", "set_free": {"most", "kg",
/// "data"}}, both in kg/m3, logarithmic in 8 bits over the decades below "most", 0 = less, 255
/// inside bodies. Null without airborne dust.
[[nodiscard]] nlohmann::json dust_field_of(const H5Source& source,
                                           const std::vector<std::string>& classes,
                                           const nlohmann::json& air);

}  // namespace dust::report

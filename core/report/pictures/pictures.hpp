// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/dust_sizes.hpp"
#include "report/h5_source.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dust::report {

/// The part of the x-z plane a picture shows [m].
struct View {
  double min_x = 0.0, min_z = 0.0, max_x = 0.0, max_z = 0.0;
  [[nodiscard]] bool is_empty() const { return !(max_x > min_x && max_z > min_z); }
  /// Widened so far that the point lies in it.
  [[nodiscard]] View with(double x, double z) const;
};

/// The space a run takes place in [m].
struct Box {
  std::array<double, 3> min{}, max{};
  [[nodiscard]] bool is_empty() const {
    return !(max[0] > min[0] && max[1] > min[1] && max[2] > min[2]);
  }
  /// So shallow along y that the view from the side tells all.
  [[nodiscard]] bool is_thin() const {
    constexpr double k_thin = 0.15;
    return max[1] - min[1] < k_thin * std::max(max[0] - min[0], max[2] - min[2]);
  }
};

/// The space of a run: the fluid's grid, the domain of the scenario, or what surfaces and grains
/// span.
[[nodiscard]] Box box_of(const H5Source& source, const std::string& scenario);

/// The view of a run: the fluid's grid, the domain of the scenario, or what grains and bodies span.
[[nodiscard]] View view_of(const H5Source& source, const nlohmann::json& bodies,
                           const std::string& scenario);

/// Body outlines for the pictures, [{"name", "polygons": [[[x, z], ..]], "segments": [[x, z, x,
/// z]], "triangles": [x, z, ..]}]: those of report.json, or else the newest wall surfaces seen
/// along y.
[[nodiscard]] nlohmann::json bodies_of(const nlohmann::json& report, const H5Source& source);

/// The grains of every frame seen along y, quantised to 16 bits per coordinate and packed; null
/// without frames. Thinned by a hash of the id when a frame or the whole would become too large, so
/// that the grains shown stay the same from frame to frame; dust is thinned only on its own
/// account. The depth y has 16 bits as well, 8 where the space is thin.
[[nodiscard]] nlohmann::json grains_of(const H5Source& source, const View& view, const Box& box,
                                       const DustSizes& dust, const nlohmann::json& classes);

/// Air speed, pressure and direction of at most 40 frames, averaged over the depth y, quantised to
/// 8 bits and packed; null for runs without fluid.
[[nodiscard]] nlohmann::json air_of(const H5Source& source);

/// A place that asks for the dust within `reach` of it.
struct DustPlace {
  double x = 0.0, z = 0.0, reach = 0.0;  ///< [m]
  std::optional<double> y;               ///< [m] none: at any depth
  double share = 0.0;                    ///< answer: of the mass of all dust in the view
};

/// The share of the dust in each square cell of the view, z rows of x, mean over the frames of the
/// second half of the run; empty without dust.
struct DustMap {
  std::size_t nx = 0, nz = 0;
  double cell = 0.0;  ///< [m]
  std::vector<double> share;
};

[[nodiscard]] DustMap dust_map_of(const H5Source& source, const View& view, const DustSizes& dust,
                                  std::vector<DustPlace>& places);

/// Dust within this many diameters of a coarse grain's centre is with the load: about the distance
/// of neighbours in a falling stream of 3 % solids.
constexpr double k_near_diameters = 2.0;

/// A square of the side view where dust parted from the load.
struct DustOrigin {
  double x = 0.0, z = 0.0;           ///< [m] middle
  std::map<double, double> volume;   ///< by diameter: sum of weight d^3 [m3]
  std::map<double, double> squares;  ///< by diameter: sum of (weight d^3)^2
  int grains = 0;                    ///< computed ones
};

/// Where dust that has parted from the coarse grains was last seen with them, in squares of `side`:
/// of all dust not near a coarse grain when last seen. As fine as the frames: what happens between
/// two of them is not seen. Dust that was never seen near a coarse grain is not counted.
[[nodiscard]] std::vector<DustOrigin> dust_origins(const H5Source& source, const View& view,
                                                   const DustSizes& dust, double side);

/// Where dust came off the grains until the last frame, by kind of cause, summed over the depth,
/// logarithmic in 8 bits, one scale for all: {"nx", "nz", "x0", "z0", "dx", "dz" [m], "decades",
/// "most" [kg per cm2], "kinds": [{"title", "kg", "data"}]}; null where none did.
[[nodiscard]] nlohmann::json release_map_of(const H5Source& source);

/// The fields that sensors keep on grids of their own, as the last frame has them: [{"sensor",
/// "name", "unit", "along", "axes", "nx", "nz", "x0", "z0", "dx", "dz" [m], "decades", "most",
/// "data"}]. Seen along the axis that shows most of what is not 0, the largest on each line of
/// sight, logarithmic in 8 bits. Fields of nothing but 0 are left out.
[[nodiscard]] nlohmann::json sensor_maps_of(const H5Source& source);

/// A map for the page, logarithmic in 8 bits; null without dust.
[[nodiscard]] nlohmann::json dust_map_json(const DustMap& map, const View& view);

}  // namespace dust::report

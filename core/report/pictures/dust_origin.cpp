// SPDX-License-Identifier: Apache-2.0
#include "report/pictures/pictures.hpp"

#include "base/cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <vector>

namespace dust::report {

namespace {

/// Coarse grains of a frame in cells of a uniform grid, to ask what is near a point.
class Coarse {
 public:
  Coarse(const std::vector<float>& position, const std::vector<float>& diameter,
         const DustSizes& dust) {
    for (const float d : diameter) {
      if (!dust.is_dust(d)) cell_ = std::max(cell_, k_near_diameters * d);
    }
    for (std::size_t k = 0; k < diameter.size() && 3 * k + 2 < position.size(); ++k) {
      if (dust.is_dust(diameter[k])) continue;
      const Grain grain{position[3 * k], position[3 * k + 1], position[3 * k + 2],
                        k_near_diameters * diameter[k]};
      cells_[base::cell_key(index(grain.x), index(grain.y), index(grain.z))].push_back(grain);
    }
  }

  /// Whether a coarse grain's centre lies within k_near_diameters of its own diameter.
  [[nodiscard]] bool has_near(double x, double y, double z) const {
    if (cells_.empty()) return false;
    const std::int64_t i = index(x), j = index(y), k = index(z);
    for (std::int64_t a = i - 1; a <= i + 1; ++a) {
      for (std::int64_t b = j - 1; b <= j + 1; ++b) {
        for (std::int64_t c = k - 1; c <= k + 1; ++c) {
          const auto found = cells_.find(base::cell_key(a, b, c));
          if (found == cells_.end()) continue;
          for (const Grain& g : found->second) {
            const double dx = x - g.x, dy = y - g.y, dz = z - g.z;
            if (dx * dx + dy * dy + dz * dz <= g.reach * g.reach) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  struct Grain {
    double x, y, z, reach;
  };
  [[nodiscard]] std::int64_t index(double v) const { return base::cell_index(v / cell_); }

  double cell_ = 1e-9;
  std::unordered_map<std::uint64_t, std::vector<Grain>> cells_;
};

/// What is known of a grain of dust so far.
struct Track {
  double x = 0.0, z = 0.0;  ///< [m] where it was last near the load
  double diameter = 0.0;    ///< [m]
  double weight = 1.0;
  bool was_near = false;  ///< at any time
  bool is_near = false;   ///< when last seen
};

}  // namespace

std::vector<DustOrigin> dust_origins(const H5Source& source, const View& view,
                                     const DustSizes& dust, double side) {
  std::unordered_map<std::int64_t, Track> tracks;
  for (const std::string& name : source.frames("/particles")) {
    const std::string path = "/particles/" + name;
    const auto position = source.floats(path + "/position");
    const auto diameter = source.floats(path + "/diameter");
    const auto weight = source.floats(path + "/weight");
    const auto id = source.integers(path + "/id");
    if (id.size() != diameter.size() || position.size() != 3 * id.size()) return {};
    const Coarse coarse(position, diameter, dust);
    for (std::size_t k = 0; k < id.size(); ++k) {
      if (!dust.is_dust(diameter[k])) continue;
      Track& track = tracks[id[k]];
      const double x = position[3 * k], y = position[3 * k + 1], z = position[3 * k + 2];
      track.diameter = diameter[k];
      track.weight = k < weight.size() ? weight[k] : 1.0;
      track.is_near = coarse.has_near(x, y, z);
      if (!track.is_near) continue;
      track.was_near = true;
      track.x = x;
      track.z = z;
    }
  }
  // Sums over the ordered squares do not depend on the order of a hash table; sums of grains are
  // made in the order of their ids.
  std::map<std::int64_t, const Track*> ordered;
  for (const auto& [id, track] : tracks) ordered[id] = &track;
  std::map<std::pair<std::int64_t, std::int64_t>, DustOrigin> squares;
  for (const auto& [id, track] : ordered) {
    if (track->is_near || !track->was_near) continue;
    const auto i = static_cast<std::int64_t>(std::floor((track->x - view.min_x) / side));
    const auto k = static_cast<std::int64_t>(std::floor((track->z - view.min_z) / side));
    DustOrigin& origin = squares[{i, k}];
    origin.x = view.min_x + (static_cast<double>(i) + 0.5) * side;
    origin.z = view.min_z + (static_cast<double>(k) + 0.5) * side;
    const double volume = track->weight * std::pow(track->diameter, 3);
    origin.volume[track->diameter] += volume;
    origin.squares[track->diameter] += volume * volume;
    ++origin.grains;
  }
  std::vector<DustOrigin> list;
  list.reserve(squares.size());
  for (const auto& [place, origin] : squares) list.push_back(origin);
  return list;
}

}  // namespace dust::report

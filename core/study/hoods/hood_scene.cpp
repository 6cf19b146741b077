// SPDX-License-Identifier: Apache-2.0
#include "study/hoods/hood_scene.hpp"

#include "base/error.hpp"
#include "report/h5_source.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dust::study {
namespace {

/// Of a cell's volume: less is a body.
constexpr float k_open = 0.99F;

std::size_t cells_of(const report::FluidGrid& grid) {
  return grid.count[0] * grid.count[1] * grid.count[2];
}

/// Adds how much of each cell solids take, in the later half of the frames.
std::vector<char> taken_cells(const report::H5Source& source, const report::FluidGrid& grid) {
  const std::size_t cells = cells_of(grid);
  const auto frames = source.frames("/fluid");
  std::vector<double> solids(cells, 0.0);
  std::vector<char> is_taken(cells, 0);
  const auto close_bodies = [&](const std::vector<float>& open) {
    for (std::size_t c = 0; c < std::min(cells, open.size()); ++c) {
      if (open[c] < k_open) is_taken[c] = 1;
    }
  };
  close_bodies(source.floats("/fluid/open_fraction"));
  const std::size_t first = frames.size() / 2;
  for (std::size_t f = first; f < frames.size(); ++f) {
    const auto voids = source.floats("/fluid/" + frames[f] + "/void_fraction");
    for (std::size_t c = 0; c < std::min(cells, voids.size()); ++c) {
      solids[c] +=
          (1.0 - static_cast<double>(voids[c])) / static_cast<double>(frames.size() - first);
    }
    close_bodies(source.floats("/fluid/" + frames[f] + "/open_fraction"));
  }
  for (std::size_t c = 0; c < cells; ++c) {
    if (solids[c] > HoodScene::k_largest_solids_fraction) is_taken[c] = 1;
  }
  return is_taken;
}

void read_grains(const report::H5Source& source, const report::DustSizes& sizes,
                 std::vector<DustPoint>& dust, std::vector<CoarseGrain>& coarse) {
  const auto frames = source.frames("/particles");
  if (frames.empty()) return;
  const std::string frame = "/particles/" + frames.back() + "/";
  const auto positions = source.floats(frame + "position");
  const auto diameters = source.floats(frame + "diameter");
  const auto masses = source.floats(frame + "mass");
  const auto weights = source.floats(frame + "weight");
  const std::size_t count = diameters.size();
  if (positions.size() != 3 * count || masses.size() != count || weights.size() != count) return;
  for (std::size_t n = 0; n < count; ++n) {
    const sdk::Vec3 at{positions[3 * n], positions[3 * n + 1], positions[3 * n + 2]};
    const auto diameter = static_cast<double>(diameters[n]);
    if (sizes.is_dust(diameter)) {
      dust.push_back({at, static_cast<double>(masses[n]) * static_cast<double>(weights[n])});
    } else {
      coarse.push_back({at, 0.5 * diameter});
    }
  }
}

/// [-] Of each cell's volume what gas fills in a frame: concentrations are those of the gas.
std::vector<double> gas_shares(const report::H5Source& source, const std::string& frame,
                               const report::FluidGrid& grid) {
  std::vector<double> shares(cells_of(grid), 1.0);
  const auto take = [&](const std::vector<float>& part) {
    for (std::size_t c = 0; c < std::min(shares.size(), part.size()); ++c) {
      shares[c] *= static_cast<double>(part[c]);
    }
  };
  const auto open = source.floats("/fluid/" + frame + "/open_fraction");
  take(open.empty() ? source.floats("/fluid/open_fraction") : open);
  take(source.floats("/fluid/" + frame + "/void_fraction"));
  return shares;
}

void read_dust_field(const report::H5Source& source, const report::RunText& run,
                     const report::FluidGrid& grid, std::vector<DustPoint>& dust) {
  const auto frames = source.frames("/fluid");
  const nlohmann::json& classes =
      report::object_at(report::object_at(run.summary, "dust_field"), "classes");
  if (frames.empty()) return;
  const double volume = grid.spacing[0] * grid.spacing[1] * grid.spacing[2];
  const std::size_t first = frames.size() / 2;
  // In the mean: clouds come and go.
  std::vector<double> amounts(cells_of(grid), 0.0);
  for (std::size_t f = first; f < frames.size(); ++f) {
    const std::vector<double> shares = gas_shares(source, frames[f], grid);
    for (const auto& item : classes.items()) {
      const auto of_frame = source.floats("/fluid/" + frames[f] + "/dust_" + item.key());
      for (std::size_t c = 0; c < std::min(amounts.size(), of_frame.size()); ++c) {
        amounts[c] += static_cast<double>(of_frame[c]) * shares[c] /
                      static_cast<double>(frames.size() - first);
      }
    }
  }
  for (std::size_t c = 0; c < amounts.size(); ++c) {
    if (!(amounts[c] > 0.0)) continue;
    const std::array<std::size_t, 3> cell{c % grid.count[0], c / grid.count[0] % grid.count[1],
                                          c / (grid.count[0] * grid.count[1])};
    sdk::Vec3 centre;
    for (int d = 0; d < 3; ++d) {
      const auto n = static_cast<std::size_t>(d);
      centre[d] = grid.origin[n] + (static_cast<double>(cell[n]) + 0.5) * grid.spacing[n];
    }
    dust.push_back({centre, amounts[c] * volume});
  }
}

}  // namespace

std::vector<LowPressurePlace> places_of(const report::RunText& run) {
  std::map<std::pair<std::string, int>, LowPressurePlace> found;
  for (const report::Figure& figure : run.figures) {
    if (figure.role != "low_pressure" || !std::isfinite(figure.value)) continue;
    LowPressurePlace& place = found[{figure.sensor, figure.index}];
    if (figure.quantity == "x") place.position.x = figure.value;
    if (figure.quantity == "y") place.position.y = figure.value;
    if (figure.quantity == "z") place.position.z = figure.value;
    if (figure.quantity == "depth_of_pressure") place.depth = figure.value;
  }
  std::vector<LowPressurePlace> places;
  for (const auto& [key, place] : found) {
    if (place.depth > 0.0) places.push_back(place);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.depth > b.depth; });
  for (std::size_t n = 0; n < places.size(); ++n) places[n].number = static_cast<int>(n) + 1;
  return places;
}

bool has_dust_grains(const report::RunText& run) {
  const nlohmann::json& classes = report::list_at(run.summary, "size_classes");
  return std::any_of(classes.begin(), classes.end(), [&](const nlohmann::json& entry) {
    const auto diameter = report::number_at(entry, "diameter_m");
    return diameter && run.dust.is_dust(*diameter);
  });
}

bool has_dust(const report::RunText& run) {
  return has_dust_grains(run) ||
         !report::object_at(report::object_at(run.summary, "dust_field"), "classes").empty();
}

HoodScene::HoodScene(const std::filesystem::path& folder, const report::RunText& run) {
  const report::H5Source source(folder / "results.h5");
  const auto grid = source.is_open() ? report::fluid_grid_of(source) : std::nullopt;
  if (!grid) {
    throw base::UserError("error: " + (folder / "results.h5").string() +
                          " holds no air, and places of low pressure are places in air: give the "
                          "folder of a run with fluid, whole");
  }
  grid_ = *grid;
  is_taken_ = taken_cells(source, grid_);
  read_grains(source, run.dust, dust_, coarse_);
  read_dust_field(source, run, grid_, dust_);
}

HoodScene::HoodScene(report::FluidGrid grid, std::vector<char> is_taken,
                     std::vector<DustPoint> dust, std::vector<CoarseGrain> coarse)
    : grid_(grid),
      is_taken_(std::move(is_taken)),
      dust_(std::move(dust)),
      coarse_(std::move(coarse)) {}

sdk::Vec3 HoodScene::min() const { return {grid_.origin[0], grid_.origin[1], grid_.origin[2]}; }

sdk::Vec3 HoodScene::max() const {
  sdk::Vec3 corner = min();
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    corner[d] += static_cast<double>(grid_.count[n]) * grid_.spacing[n];
  }
  return corner;
}

bool HoodScene::is_clear(sdk::Vec3 low, sdk::Vec3 high) const {
  std::array<std::size_t, 3> first{}, end{};
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    const auto cells = static_cast<double>(grid_.count[n]);
    const double from = (low[d] - grid_.origin[n]) / grid_.spacing[n];
    const double to = (high[d] - grid_.origin[n]) / grid_.spacing[n];
    constexpr double k_rounding = 1e-6;  // a face on a cell's face does not reach into it
    first[n] = static_cast<std::size_t>(std::clamp(std::floor(from + k_rounding), 0.0, cells));
    end[n] = static_cast<std::size_t>(std::clamp(std::ceil(to - k_rounding), 0.0, cells));
  }
  for (std::size_t k = first[2]; k < end[2]; ++k) {
    for (std::size_t j = first[1]; j < end[1]; ++j) {
      for (std::size_t i = first[0]; i < end[0]; ++i) {
        if (is_taken_[i + grid_.count[0] * (j + grid_.count[1] * k)] != 0) return false;
      }
    }
  }
  return std::none_of(coarse_.begin(), coarse_.end(), [&](const CoarseGrain& grain) {
    for (int d = 0; d < 3; ++d) {
      if (grain.position[d] < low[d] - grain.radius) return false;
      if (grain.position[d] > high[d] + grain.radius) return false;
    }
    return true;
  });
}

double HoodScene::dust_in(sdk::Vec3 low, sdk::Vec3 high) const {
  double mass = 0.0;
  for (const DustPoint& point : dust_) {
    const sdk::Vec3& p = point.position;
    const bool is_inside = p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y &&
                           p.z >= low.z && p.z <= high.z;
    if (is_inside) mass += point.mass;
  }
  return mass;
}

sdk::Vec3 HoodScene::middle_of_taken() const {
  sdk::Vec3 sum;
  double count = 0.0;
  for (std::size_t c = 0; c < is_taken_.size(); ++c) {
    if (is_taken_[c] == 0) continue;
    const std::array<std::size_t, 3> cell{c % grid_.count[0], c / grid_.count[0] % grid_.count[1],
                                          c / (grid_.count[0] * grid_.count[1])};
    for (int d = 0; d < 3; ++d) {
      const auto n = static_cast<std::size_t>(d);
      sum[d] += grid_.origin[n] + (static_cast<double>(cell[n]) + 0.5) * grid_.spacing[n];
    }
    count += 1.0;
  }
  return count > 0.0 ? (1.0 / count) * sum : 0.5 * (min() + max());
}

}  // namespace dust::study

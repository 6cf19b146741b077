// SPDX-License-Identifier: Apache-2.0
#include "report/blob.hpp"
#include "report/fluid_grid.hpp"
#include "report/pictures/colour_code.hpp"
#include "report/pictures/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::report {

namespace {

using nlohmann::json;

constexpr std::size_t k_air_frames = 40;
constexpr std::size_t k_map_x = 264, k_map_z = 280;  ///< largest picture [cells]
constexpr std::size_t k_arrows = 70;              ///< longest side of the direction field [cells]
constexpr std::size_t k_whole_field = 64u << 20;  ///< numbers; larger fields: middle plane only
constexpr double k_codes = 254.0;

struct Grid {
  std::size_t nx = 0, ny = 0, nz = 0;
  bool is_middle_plane = false;
};

/// A plane of numbers, z rows of x; `weight` is the open share of each cell, 0 inside bodies.
struct Plane {
  std::size_t nx = 0, nz = 0;
  std::vector<float> u, w, pressure, weight;
};

void resize(Plane& plane, std::size_t nx, std::size_t nz) {
  plane.nx = nx;
  plane.nz = nz;
  for (auto* part : {&plane.u, &plane.w, &plane.pressure, &plane.weight})
    part->assign(nx * nz, 0.0F);
}

float finite(float value) { return std::isfinite(value) ? value : 0.0F; }

/// Adds row y of a frame to the sums over the depth.
void add_row(Plane& sum, const Grid& grid, const std::vector<float>& velocity,
             const std::vector<float>& pressure, const std::vector<float>& open, std::size_t y,
             std::size_t rows) {
  for (std::size_t z = 0; z < grid.nz; ++z) {
    for (std::size_t x = 0; x < grid.nx; ++x) {
      const std::size_t cell = (z * rows + y) * grid.nx + x;
      const float weight = cell < open.size() ? open[cell] : 1.0F;
      const std::size_t at = z * grid.nx + x;
      sum.weight[at] += weight;
      sum.u[at] += weight * finite(velocity[3 * cell]);
      sum.w[at] += weight * finite(velocity[3 * cell + 2]);
      if (cell < pressure.size()) sum.pressure[at] += weight * finite(pressure[cell]);
    }
  }
}

/// Means over the depth (or the middle plane); false when the frame has no velocity of that shape.
bool read_plane(const H5Source& source, const std::string& frame, const Grid& grid, Plane& mean) {
  const std::size_t cells = grid.nx * grid.nz * (grid.is_middle_plane ? 1 : grid.ny);
  const auto field = [&](const std::string& path) {
    return grid.is_middle_plane ? source.plane(path, grid.ny / 2) : source.floats(path);
  };
  const auto velocity = field(frame + "/velocity");
  if (velocity.size() != 3 * cells) return false;
  const auto pressure = field(frame + "/pressure");
  auto open = field(frame + "/open_fraction");  // where bodies move or are taken away
  if (open.empty()) open = field("/fluid/open_fraction");
  resize(mean, grid.nx, grid.nz);
  const std::size_t rows = grid.is_middle_plane ? 1 : grid.ny;
  for (std::size_t y = 0; y < rows; ++y) add_row(mean, grid, velocity, pressure, open, y, rows);
  for (auto& weight : mean.weight) weight /= static_cast<float>(rows);
  for (std::size_t k = 0; k < mean.weight.size(); ++k) {
    const float sum = mean.weight[k] * static_cast<float>(rows);
    if (sum <= 0.0F) continue;
    mean.u[k] /= sum;
    mean.w[k] /= sum;
    mean.pressure[k] /= sum;
  }
  return true;
}

/// Blocks of `fx` by `fz` cells averaged over their open part.
Plane coarsened(const Plane& fine, std::size_t fx, std::size_t fz) {
  Plane coarse;
  resize(coarse, (fine.nx + fx - 1) / fx, (fine.nz + fz - 1) / fz);
  std::vector<float> counts(coarse.weight.size(), 0.0F);
  for (std::size_t z = 0; z < fine.nz; ++z) {
    for (std::size_t x = 0; x < fine.nx; ++x) {
      const std::size_t from = z * fine.nx + x;
      const std::size_t to = z / fz * coarse.nx + x / fx;
      const float weight = fine.weight[from];
      counts[to] += 1.0F;
      coarse.weight[to] += weight;
      coarse.u[to] += weight * fine.u[from];
      coarse.w[to] += weight * fine.w[from];
      coarse.pressure[to] += weight * fine.pressure[from];
    }
  }
  for (std::size_t k = 0; k < coarse.weight.size(); ++k) {
    if (coarse.weight[k] > 0.0F) {
      coarse.u[k] /= coarse.weight[k];
      coarse.w[k] /= coarse.weight[k];
      coarse.pressure[k] /= coarse.weight[k];
    }
    coarse.weight[k] /= counts[k];
  }
  return coarse;
}

/// The value below which 99.8 % of the open cells of a frame lie: a few extreme cells shall not
/// wash out the picture; the caption names the true extreme.
double robust_maximum(std::vector<float> values) {
  if (values.empty()) return 0.0;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(0.998 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::uint8_t code(double share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * k_codes));
}

/// Velocities are stored by their root: 8 bits then tell slow air apart as well, which carries
/// dust.
double root(double share) { return std::copysign(std::sqrt(std::abs(share)), share); }

/// Differences to the left neighbour compress to about half; the reader sums them up again.
void put_differences(std::vector<std::uint8_t>& bytes, const std::vector<std::uint8_t>& codes) {
  std::uint8_t last = 0;
  for (const std::uint8_t c : codes) {
    bytes.push_back(static_cast<std::uint8_t>(c - last));
    last = c;
  }
}

struct Range {
  double speed = 0.0, pressure = 0.0;             ///< shown
  double top_speed = 0.0, low = 0.0, high = 0.0;  ///< met
};

/// The scales end where the fullest frame has 99.8 % of its cells below: frames before the air
/// moves shall not count.
Range range_of(const std::vector<Plane>& planes) {
  Range range;
  for (const Plane& plane : planes) {
    std::vector<float> speeds, pressures;
    for (std::size_t k = 0; k < plane.weight.size(); ++k) {
      if (plane.weight[k] < 0.5F) continue;
      speeds.push_back(std::hypot(plane.u[k], plane.w[k]));
      pressures.push_back(std::abs(plane.pressure[k]));
      range.top_speed = std::max<double>(range.top_speed, speeds.back());
      range.low = std::min<double>(range.low, plane.pressure[k]);
      range.high = std::max<double>(range.high, plane.pressure[k]);
    }
    range.speed = std::max(range.speed, robust_maximum(std::move(speeds)));
    range.pressure = std::max(range.pressure, robust_maximum(std::move(pressures)));
  }
  if (!(range.speed > 0.0)) range.speed = range.top_speed > 0.0 ? range.top_speed : 1.0;
  if (!(range.pressure > 0.0)) range.pressure = std::max({-range.low, range.high, 1e-12});
  return range;
}

json encoded(const Plane& map, const Plane& arrows, const Range& range, double time) {
  std::vector<std::uint8_t> speed, pressure, u, w, bytes;
  for (std::size_t k = 0; k < map.weight.size(); ++k) {
    const bool is_open = map.weight[k] >= 0.5F;
    speed.push_back(is_open ? code(std::sqrt(std::hypot(map.u[k], map.w[k]) / range.speed))
                            : k_masked);
    pressure.push_back(is_open ? code(0.5 + 0.5 * map.pressure[k] / range.pressure) : k_masked);
  }
  for (std::size_t k = 0; k < arrows.weight.size(); ++k) {
    const bool is_open = arrows.weight[k] >= 0.5F;
    u.push_back(is_open ? code(0.5 + 0.5 * root(arrows.u[k] / range.speed)) : k_masked);
    w.push_back(is_open ? code(0.5 + 0.5 * root(arrows.w[k] / range.speed)) : k_masked);
  }
  for (const auto* part : {&speed, &pressure, &u, &w}) put_differences(bytes, *part);
  return {{"t", time}, {"data", packed(bytes)}};
}

/// Mean over the frames of the second half of the run, of each cell while it was open.
Plane mean_of(const std::vector<Plane>& maps, const std::vector<double>& times, double from) {
  Plane mean;
  resize(mean, maps.back().nx, maps.back().nz);
  float frames = 0.0F;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    if (times[k] < from && k + 1 < maps.size()) continue;
    frames += 1.0F;
    for (std::size_t i = 0; i < mean.weight.size(); ++i) {
      const float weight = maps[k].weight[i];
      mean.weight[i] += weight;
      mean.u[i] += weight * maps[k].u[i];
      mean.w[i] += weight * maps[k].w[i];
      mean.pressure[i] += weight * maps[k].pressure[i];
    }
  }
  for (std::size_t i = 0; i < mean.weight.size(); ++i) {
    for (auto* part : {&mean.u, &mean.w, &mean.pressure}) {
      if (mean.weight[i] > 0.0F) (*part)[i] /= mean.weight[i];
    }
    mean.weight[i] /= frames;
  }
  return mean;
}

/// The frames of a run as maps seen along y.
struct Maps {
  std::vector<Plane> planes;
  std::vector<double> times;   ///< [s]
  std::size_t fx = 1, fz = 1;  ///< cells of the grid in one of the maps
};

/// Of at most k_air_frames.
Maps maps_of(const H5Source& source, const std::vector<std::string>& names, const Grid& grid) {
  Maps maps;
  maps.fx = (grid.nx + k_map_x - 1) / k_map_x;
  maps.fz = (grid.nz + k_map_z - 1) / k_map_z;
  for (const std::size_t k : spread_frames(names.size(), k_air_frames)) {
    const std::string frame = "/fluid/" + names[k];
    Plane mean;
    if (!read_plane(source, frame, grid, mean)) continue;
    maps.planes.push_back(coarsened(mean, maps.fx, maps.fz));
    const auto time = source.attribute(frame, "time");
    maps.times.push_back(time.empty() ? static_cast<double>(k) : time[0]);
  }
  return maps;
}

Grid grid_of(const FluidGrid& fluid) {
  Grid grid{.nx = fluid.count[0], .ny = fluid.count[1], .nz = fluid.count[2]};
  grid.is_middle_plane = 3 * grid.nx * grid.ny * grid.nz > k_whole_field;
  return grid;
}

}  // namespace

json air_of(const H5Source& source) {
  const auto names = source.frames("/fluid");
  const auto fluid = fluid_grid_of(source);
  if (names.empty() || !fluid) return nullptr;
  const Grid grid = grid_of(*fluid);
  const Maps maps = maps_of(source, names, grid);
  if (maps.planes.empty()) return nullptr;

  const Range range = range_of(maps.planes);
  const Plane& first = maps.planes.front();
  const std::size_t block = (std::max(first.nx, first.nz) + k_arrows - 1) / k_arrows;
  json frames = json::array();
  for (std::size_t k = 0; k < maps.planes.size(); ++k) {
    const Plane& map = maps.planes[k];
    frames.push_back(encoded(map, coarsened(map, block, block), range, maps.times[k]));
  }
  const double half = 0.5 * maps.times.back();
  const Plane mean = mean_of(maps.planes, maps.times, half);
  const Plane mean_arrows = coarsened(mean, block, block);
  const double width = static_cast<double>(maps.fx) * fluid->spacing[0];
  const double height = static_cast<double>(maps.fz) * fluid->spacing[2];
  return {{"nx", first.nx},
          {"nz", first.nz},
          {"ax", mean_arrows.nx},
          {"az", mean_arrows.nz},
          {"x0", fluid->origin[0]},
          {"z0", fluid->origin[2]},
          {"dx", width},
          {"dz", height},
          {"adx", width * static_cast<double>(block)},
          {"adz", height * static_cast<double>(block)},
          {"speed", range.speed},
          {"pressure", range.pressure},
          {"top_speed", range.top_speed},
          {"low", range.low},
          {"high", range.high},
          {"written", names.size()},
          {"middle", grid.is_middle_plane},
          {"mean", encoded(mean, mean_arrows, range, half)},
          {"frames", frames}};
}

}  // namespace dust::report

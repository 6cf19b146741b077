// SPDX-License-Identifier: Apache-2.0
#include "report/blob.hpp"
#include "report/fluid_grid.hpp"
#include "report/pictures/colour_code.hpp"
#include "report/space/space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dust::report {

namespace {

using nlohmann::json;

constexpr const char* k_causes[] = {"walls", "grains", "wind"};

/// The blocks of cells of the air, which the dust shares.
struct Blocks {
  Count cells, size, count;
  std::vector<float> open;  ///< share of a cell that is air; empty: all of it

  [[nodiscard]] std::size_t of(std::size_t cell) const {
    const std::size_t x = cell % cells[0];
    const std::size_t y = cell / cells[0] % cells[1];
    const std::size_t z = cell / cells[0] / cells[1];
    return (z / size[2] * count[1] + y / size[1]) * count[0] + x / size[0];
  }
};

/// Mass per volume of air [kg/m3] of each block, NaN where less than half of it is air.
std::vector<double> concentrations(const std::vector<double>& of_cells, const Blocks& blocks) {
  std::vector<double> mass(product(blocks.count), 0.0);
  std::vector<double> air(mass.size(), 0.0);
  std::vector<double> all(mass.size(), 0.0);
  for (std::size_t cell = 0; cell < of_cells.size(); ++cell) {
    const std::size_t to = blocks.of(cell);
    const double open = cell < blocks.open.size() ? blocks.open[cell] : 1.0;
    if (std::isfinite(of_cells[cell])) mass[to] += open * of_cells[cell];
    air[to] += open;
    all[to] += 1.0;
  }
  for (std::size_t k = 0; k < mass.size(); ++k) {
    mass[k] = air[k] >= 0.5 * all[k] && air[k] > 0.0 ? mass[k] / air[k] : std::nan("");
  }
  return mass;
}

/// The sum of the fields `names` of a frame, cell by cell; empty where it has none of them.
std::vector<double> sum_of(const H5Source& source, const std::string& frame,
                           const std::vector<std::string>& names, std::size_t cells) {
  std::vector<double> sums;
  for (const std::string& name : names) {
    const auto values = source.floats(frame + "/" + name);
    if (values.size() != cells) continue;
    sums.resize(cells, 0.0);
    std::transform(sums.begin(), sums.end(), values.begin(), sums.begin(), std::plus<>());
  }
  return sums;
}

/// Nothing is drawn of what is less than the scale holds; differences compress better.
std::string codes_of(const std::vector<double>& values, double most) {
  std::vector<std::uint8_t> bytes;
  std::uint8_t last = 0;
  for (const double value : values) {
    std::uint8_t code = std::isfinite(value) ? std::uint8_t{0} : k_masked;
    const double place = place_on_scale(value, most);
    if (place >= 0.0) code = colour_code(place);
    bytes.push_back(static_cast<std::uint8_t>(code - last));
    last = code;
  }
  return packed(bytes);
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) {
    if (value > most) most = value;
  }
  return most;
}

/// Mass that left the grains until the last frame, per volume of the block [kg/m3].
json set_free_of(const H5Source& source, const std::string& frame, const Blocks& blocks,
                 double cell_volume) {
  std::vector<std::string> names;
  for (const char* cause : k_causes) names.push_back(std::string("dust_set_free_by_") + cause);
  const auto of_cells = sum_of(source, frame, names, product(blocks.cells));
  std::vector<double> density(product(blocks.count), 0.0);
  std::vector<double> cells(density.size(), 0.0);
  double all = 0.0;
  for (std::size_t cell = 0; cell < of_cells.size(); ++cell) {
    density[blocks.of(cell)] += of_cells[cell];
    cells[blocks.of(cell)] += cell_volume;
    all += of_cells[cell];
  }
  if (!(all > 0.0)) return nullptr;
  for (std::size_t k = 0; k < density.size(); ++k) density[k] /= std::max(cells[k], cell_volume);
  const double most = largest(density);
  return {{"most", most}, {"kg", all}, {"data", codes_of(density, most)}};
}

}  // namespace

json dust_field_of(const H5Source& source, const std::vector<std::string>& classes,
                   const json& air) {
  const auto frames = source.frames("/fluid");
  const auto grid = fluid_grid_of(source);
  if (frames.empty() || !grid || !air.is_object() || classes.empty()) return nullptr;
  std::vector<std::string> names;
  names.reserve(classes.size());
  for (const std::string& name : classes) names.push_back("dust_" + name);
  Blocks blocks{grid->count, air["cells_per_block"].get<Count>(), air["count"].get<Count>(),
                source.floats("/fluid/open_fraction")};
  std::vector<std::pair<double, std::vector<double>>> fields;
  double most = 0.0;
  for (const std::size_t k : spread_frames(frames.size(), air["frames"].size())) {
    const std::string frame = "/fluid/" + frames[k];
    const auto of_cells = sum_of(source, frame, names, product(blocks.cells));
    if (of_cells.empty()) continue;
    const auto own = source.floats(frame + "/open_fraction");  // where bodies move
    if (!own.empty()) blocks.open = own;
    const auto time = source.attribute(frame, "time");
    fields.emplace_back(time.empty() ? static_cast<double>(k) : time[0],
                        concentrations(of_cells, blocks));
    most = std::max(most, largest(fields.back().second));
  }
  if (!(most > 0.0)) return nullptr;
  json drawn = json::array();
  for (const auto& [time, values] : fields) {
    drawn.push_back({{"t", time}, {"data", codes_of(values, most)}});
  }
  const double volume = grid->spacing[0] * grid->spacing[1] * grid->spacing[2];
  return {{"frames", std::move(drawn)},
          {"most", most},
          {"decades", k_decades},
          {"set_free", set_free_of(source, "/fluid/" + frames.back(), blocks, volume)}};
}

}  // namespace dust::report

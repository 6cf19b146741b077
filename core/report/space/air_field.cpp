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

constexpr std::size_t k_field_frames = 24;
constexpr std::size_t k_all_bytes = 9u << 20;        ///< before compression, which halves them
constexpr std::size_t k_finest = 260000;             ///< blocks: more than a slice can show
constexpr std::size_t k_largest_field = 128u << 20;  ///< numbers of a frame that are read at all

/// The air of a frame in blocks.
struct Field {
  double time = 0.0;
  std::vector<float> velocity;  ///< three by three, x first
  std::vector<float> open;      ///< share of the block
};

/// Blocks as near to cubes as whole cells allow, so many that all frames fit on the page.
Count blocks_of(const Count& cells, const std::array<double, 3>& spacing, std::size_t frames) {
  const std::size_t most = std::min(k_finest, k_all_bytes / 3 / std::max<std::size_t>(1, frames));
  double edge = std::min({spacing[0], spacing[1], spacing[2]});
  for (;; edge *= 1.05) {
    Count size{}, count{};
    for (std::size_t d = 0; d < 3; ++d) {
      size[d] = std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(edge / spacing[d])), 1,
                                        cells[d]);
      count[d] = (cells[d] + size[d] - 1) / size[d];
    }
    if (product(count) <= most || count == Count{1, 1, 1}) return size;
  }
}

Field blocks(const std::vector<float>& velocity, const std::vector<float>& open, const Count& cells,
             const Count& size, const Count& count) {
  Field field;
  field.velocity.assign(3 * product(count), 0.0F);
  field.open.assign(product(count), 0.0F);
  std::vector<float> seen(product(count), 0.0F);
  for (std::size_t z = 0, cell = 0; z < cells[2]; ++z) {
    for (std::size_t y = 0; y < cells[1]; ++y) {
      for (std::size_t x = 0; x < cells[0]; ++x, ++cell) {
        const std::size_t to = (z / size[2] * count[1] + y / size[1]) * count[0] + x / size[0];
        const float weight = cell < open.size() ? open[cell] : 1.0F;
        seen[to] += 1.0F;
        field.open[to] += weight;
        for (std::size_t d = 0; d < 3; ++d) {
          const float v = velocity[3 * cell + d];
          if (std::isfinite(v)) field.velocity[3 * to + d] += weight * v;
        }
      }
    }
  }
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (field.open[k] > 0.0F) {
      for (std::size_t d = 0; d < 3; ++d) field.velocity[3 * k + d] /= field.open[k];
    }
    field.open[k] /= seen[k];
  }
  return field;
}

/// The speed below which 99.8 % of the open blocks of the fullest frame lie, as for the maps.
double scale_of(const std::vector<Field>& fields) {
  double scale = 0.0, top = 0.0;
  for (const Field& field : fields) {
    std::vector<float> speeds;
    for (std::size_t k = 0; k < field.open.size(); ++k) {
      if (field.open[k] < 0.5F) continue;
      speeds.push_back(
          std::hypot(field.velocity[3 * k], field.velocity[3 * k + 1], field.velocity[3 * k + 2]));
      top = std::max<double>(top, speeds.back());
    }
    if (speeds.empty()) continue;
    const auto place = speeds.begin() +
                       static_cast<std::ptrdiff_t>(0.998 * static_cast<double>(speeds.size() - 1));
    std::nth_element(speeds.begin(), place, speeds.end());
    scale = std::max<double>(scale, *place);
  }
  return scale > 0.0 ? scale : std::max(top, 1e-12);
}

json encoded(const Field& field, double scale) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t d = 0; d < 3; ++d) {
    std::uint8_t last = 0;
    for (std::size_t k = 0; k < field.open.size(); ++k) {
      std::uint8_t code = k_masked;
      if (field.open[k] >= 0.5F) {
        const double share = std::clamp(field.velocity[3 * k + d] / scale, -1.0, 1.0);
        code = static_cast<std::uint8_t>(
            std::lround(127.0 + 127.0 * std::copysign(std::sqrt(std::abs(share)), share)));
      }
      bytes.push_back(static_cast<std::uint8_t>(code - last));  // differences compress better
      last = code;
    }
  }
  return {{"t", field.time}, {"data", packed(bytes)}};
}

}  // namespace

json air_field_of(const H5Source& source) {
  const auto names = source.frames("/fluid");
  const auto grid = fluid_grid_of(source);
  if (names.empty() || !grid) return nullptr;
  const Count& cells = grid->count;
  const std::array<double, 3>& edge = grid->spacing;
  if (3 * product(cells) > k_largest_field) return nullptr;
  const auto kept = spread_frames(names.size(), k_field_frames);
  const Count size = blocks_of(cells, edge, kept.size());
  Count count{};
  for (std::size_t d = 0; d < 3; ++d) count[d] = (cells[d] + size[d] - 1) / size[d];
  const auto open = source.floats("/fluid/open_fraction");
  std::vector<Field> fields;
  for (const std::size_t k : kept) {
    const std::string frame = "/fluid/" + names[k];
    const auto velocity = source.floats(frame + "/velocity");
    if (velocity.size() != 3 * product(cells)) continue;
    const auto own = source.floats(frame + "/open_fraction");  // where bodies move
    fields.push_back(blocks(velocity, own.empty() ? open : own, cells, size, count));
    const auto time = source.attribute(frame, "time");
    fields.back().time = time.empty() ? static_cast<double>(k) : time[0];
  }
  if (fields.empty()) return nullptr;
  const double scale = scale_of(fields);
  json frames = json::array();
  for (const Field& field : fields) frames.push_back(encoded(field, scale));
  json step = json::array();
  for (std::size_t d = 0; d < 3; ++d) step.push_back(edge[d] * static_cast<double>(size[d]));
  return {{"frames", std::move(frames)},
          {"origin", grid->origin},
          {"step", std::move(step)},
          {"count", count},
          {"speed", scale},
          {"written", names.size()},
          {"cells_per_block", size}};
}

}  // namespace dust::report

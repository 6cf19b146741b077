// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/displaced_grid.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace dust::particles {

DisplacedGrid::DisplacedGrid(std::span<const Ball> displaced, double around,
                             const contact::Images& images) {
  double edge = 0.0;
  for (const Ball& b : displaced) edge = std::max(edge, b.reach + around);
  for (int d = 0; d < 3; ++d) {
    inverse_[d] = 1.0 / edge;
    if (images.length[d] <= 0.0) continue;
    count_[d] = std::max<std::int64_t>(1, static_cast<std::int64_t>(images.length[d] / edge));
    inverse_[d] = static_cast<double>(count_[d]) / images.length[d];
  }
  const std::size_t size = std::bit_ceil(64 * displaced.size() + 64);
  shift_ = 64 - std::countr_zero(size);
  std::vector<std::pair<std::uint32_t, std::int32_t>> entries;
  for (std::size_t s = 0; s < displaced.size(); ++s) {
    const double centre[3] = {displaced[s].x, displaced[s].y, displaced[s].z};
    std::int64_t low[3];
    std::int64_t high[3];
    for (int d = 0; d < 3; ++d) {
      low[d] = cell(centre[d] - displaced[s].reach - around, d);
      high[d] = cell(centre[d] + displaced[s].reach + around, d);
      if (count_[d] > 0) high[d] = std::min(high[d], low[d] + count_[d] - 1);
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          entries.emplace_back(slot(x, y, z), static_cast<std::int32_t>(s));
        }
      }
    }
  }
  std::sort(entries.begin(), entries.end());
  // Two cells of one particle may share a slot.
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  begin_.assign(size + 1, 0);
  for (const auto& e : entries) ++begin_[e.first + 1];
  for (std::size_t n = 1; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
  numbers_.reserve(entries.size());
  for (const auto& e : entries) numbers_.push_back(e.second);
}

}  // namespace dust::particles

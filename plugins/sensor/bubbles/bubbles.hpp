// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dust::model::bubbles {

/// A box of cells, x fastest. A cell is empty where its share is above 0.
struct Cells {
  int count[3] = {0, 0, 0};
  std::vector<double> share;  ///< [-] 0 dense .. 1 nothing but fluid; < 0 no part of the bed

  [[nodiscard]] std::size_t size() const { return share.size(); }
};

/// Number of the connected region of each cell, from 1; 0 where the cell is dense. Cells are
/// connected through their faces. Regions are numbered by their first cell.
inline std::vector<std::int64_t> connected_regions(const Cells& cells) {
  std::vector<std::int64_t> region(cells.size(), 0);
  std::vector<std::size_t> open;
  std::int64_t regions = 0;
  const std::size_t stride[3] = {
      1, static_cast<std::size_t>(cells.count[0]),
      static_cast<std::size_t>(cells.count[0]) * static_cast<std::size_t>(cells.count[1])};
  for (std::size_t start = 0; start < cells.size(); ++start) {
    if (!(cells.share[start] > 0.0) || region[start] != 0) continue;
    region[start] = ++regions;
    open.assign(1, start);
    while (!open.empty()) {
      const std::size_t c = open.back();
      open.pop_back();
      for (int d = 0; d < 3; ++d) {
        const auto n = static_cast<std::size_t>(cells.count[d]);
        const std::size_t at = c / stride[d] % n;
        for (const bool is_up : {false, true}) {
          if (is_up ? at + 1 == n : at == 0) continue;
          const std::size_t other = is_up ? c + stride[d] : c - stride[d];
          if (!(cells.share[other] > 0.0) || region[other] != 0) continue;
          region[other] = regions;
          open.push_back(other);
        }
      }
    }
  }
  return region;
}

}  // namespace dust::model::bubbles

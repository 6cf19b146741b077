// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// What the search looks at: rows of four doubles.
struct SearchInput {
  std::size_t count = 0;
  const double* position = nullptr;  ///< x, y, z, radius
  const double* velocity = nullptr;
  std::size_t velocity_stride = 4;  ///< doubles from one grain's to the next
  const double* skin = nullptr;     ///< fourth column of rows: allowed deviation [m]
  double lifetime = 0.0;            ///< [s] for how long the list is to hold
  double range = 0.0;               ///< [m] beyond touch
  double origin[3] = {0, 0, 0};
  double period[3] = {0, 0, 0};  ///< [m] 0 = not periodic

  [[nodiscard]] double radius(std::size_t n) const { return position[4 * n + 3]; }
  [[nodiscard]] double skin_of(std::size_t n) const { return skin[4 * n + 3]; }
};

/// All places a grain may be at until the lifetime is over: the middle of its straight path and
/// round it the radius, the skin and half the path.
struct Ball {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double reach = 0.0;
};

using RowPair = std::array<std::int32_t, 2>;

/// All pairs that may touch within the lifetime: if both went straight on, they would come closer
/// than their radii plus their skins. Each pair once, in blocks of up to `block` grains whose
/// order depends on the input alone; the first grain of a pair is not the coarser one by a level.
///
/// Cells per size level (factor 2): a grain looks into the cells of its own level and of the
/// coarser ones, so that dust among sand costs in proportion to the number of grains.
std::vector<std::vector<RowPair>> search_pairs(const SearchInput& input, std::size_t block);

}  // namespace dust::particles

// SPDX-License-Identifier: Apache-2.0
#include "contact/standing.hpp"

#include "base/lanes.hpp"
#include "dust/sdk/plugin.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace dust::contact {
using namespace lanes;

namespace {

constexpr std::size_t k_block = k_batch * static_cast<std::size_t>(k_max_history);

/// `rows` rows of `width` into `width` columns of `rows`; both multiples of four.
DUST_KERNEL void transpose_block(const double* from, std::size_t rows, std::size_t width,
                                 double* to) {
  for (std::size_t q = 0; q < rows; q += 4) {
    for (std::size_t g = 0; g < width; g += 4) {
      Lanes h[4];
      const double* r = from + q * width + g;
      columns_of(r, r + width, r + 2 * width, r + 3 * width, h);
      for (std::size_t l = 0; l < 4; ++l) store(to + (g + l) * rows + q, h[l]);
    }
  }
}

void turn(double* block, std::size_t rows, std::size_t width) {
  alignas(64) double copy[k_block];
  std::copy_n(block, rows * width, copy);
  transpose_block(copy, rows, width, block);
}

/// Visits those that have parted, few among many.
template <class Visit>
void each_apart(const std::uint8_t* is_touching, std::size_t count, Visit&& visit) {
  constexpr std::uint64_t k_all = 0x0101010101010101u;
  for (std::size_t first = 0; first < count; first += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, is_touching + first, 8);
    for (std::uint64_t apart = eight ^ k_all; apart != 0; apart &= apart - 1) {
      visit(first + static_cast<std::size_t>(std::countr_zero(apart)) / 8);
    }
  }
}

}  // namespace

void rows_to_columns(double* block, std::size_t count, std::size_t stride) {
  turn(block, count, stride);
}
void columns_to_rows(double* block, std::size_t count, std::size_t stride) {
  turn(block, stride, count);
}

void mask_separated(const std::uint8_t* is_touching, std::size_t count, BatchColumns& columns) {
  using B = BatchColumns;
  each_apart(is_touching, count, [&](std::size_t q) {
    for (const int c : {B::overlap, B::velocity_x, B::velocity_y, B::velocity_z, B::displacement_x,
                        B::displacement_y, B::displacement_z}) {
      columns.column(c)[q] = 0.0;
    }
  });
}

void clear_separated(const std::uint8_t* is_touching, std::size_t count, std::size_t stride,
                     BatchColumns& columns) {
  using B = BatchColumns;
  each_apart(is_touching, count, [&](std::size_t q) {
    for (int d = 0; d < 3; ++d) {
      columns.column(B::force_x + d)[q] = 0.0;
      columns.column(B::torque_i_x + d)[q] = 0.0;
      columns.column(B::torque_j_x + d)[q] = 0.0;
      columns.column(B::torque_x + d)[q] = 0.0;
    }
    for (std::size_t h = 0; h < stride; ++h) columns.history()[h][q] = 0.0;
  });
}

}  // namespace dust::contact

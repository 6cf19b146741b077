// SPDX-License-Identifier: Apache-2.0
#include "particles/store/row_order.hpp"

#include <algorithm>
#include <utility>

namespace dust::particles {
namespace {

/// Two zeros behind each of the lower 21 bits.
std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffull;
  v = (v | v << 16) & 0x1f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  v = (v | v << 2) & 0x1249249249249249ull;
  return v;
}
constexpr double k_last_cell = 2097151.0;  // 2^21 - 1

}  // namespace

RowOrder morton_order(const double* position, std::size_t count, sdk::Vec3 origin, double edge,
                      double coarse_limit) {
  RowOrder result;
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(count);
  for (std::size_t n = 0; n < count; ++n) {
    const double* p = position + 4 * n;
    std::uint64_t key = 0;
    for (int d = 0; d < 3; ++d) {
      const double cell = std::clamp((p[d] - origin[d]) / edge, 0.0, k_last_cell);
      key |= spread_bits(static_cast<std::uint64_t>(cell)) << d;
    }
    const bool is_coarse = 2.0 * p[3] >= coarse_limit;
    result.coarse_count += is_coarse ? 1 : 0;
    keys[n] = {(is_coarse ? 0 : std::uint64_t{1} << 63) | key, static_cast<std::int32_t>(n)};
  }
  std::sort(keys.begin(), keys.end());
  result.order.resize(count);
  for (std::size_t n = 0; n < count; ++n) result.order[n] = keys[n].second;
  return result;
}

}  // namespace dust::particles

// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/skins.hpp"

#include "base/cells.hpp"
#include "particles/neighbours/reference_trajectories.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace dust::particles {
namespace {

/// Skin of a fine particle that stands alone, in diameters of the largest; in a crowd it is half
/// the mean distance, so that a pocket of dust does not list its far neighbours, but no less than
/// this share of its own diameter.
constexpr double k_isolated_skin = 0.3;
constexpr double k_dense_skin = 0.15;
/// Edge of the cells in which a crowd is counted, in diameters of the largest particle: small, so
/// that the empty space round a pocket does not thin it out.
constexpr double k_dense_edge = 0.2;

}  // namespace

void choose_skins(const SkinInput& in, ReferenceTrajectories& trajectories) {
  for (std::size_t n = 0; n < in.coarse_count; ++n) {
    trajectories.set_skin(n, in.skin_in_diameters * in.diameter(n));
  }
  if (in.coarse_count == in.count) return;
  const double isolated = k_isolated_skin * in.largest_diameter;
  const double edge = k_dense_edge * in.largest_diameter;
  std::unordered_map<std::uint64_t, std::int32_t> dense;
  std::vector<std::uint64_t> key_of(in.count - in.coarse_count);
  for (std::size_t n = in.coarse_count; n < in.count; ++n) {
    const double* p = in.position + 4 * n;
    const auto cell = [&](int d) { return base::cell_index((p[d] - in.origin[d]) / edge); };
    const std::uint64_t key = base::cell_key(cell(0), cell(1), cell(2));
    key_of[n - in.coarse_count] = key;
    ++dense[key];
  }
  for (std::size_t n = in.coarse_count; n < in.count; ++n) {
    const double diameter = in.diameter(n);
    const std::int32_t here = dense[key_of[n - in.coarse_count]];
    const double spacing = edge / std::cbrt(static_cast<double>(here));
    trajectories.set_skin(
        n, here == 1 ? isolated
                     : std::max(k_dense_skin * diameter, std::min(isolated, 0.5 * spacing)));
  }
}

}  // namespace dust::particles

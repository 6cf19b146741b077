// SPDX-License-Identifier: Apache-2.0
#include "setup/dust_rule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dust::scenario {
namespace {

/// Sizes are written in decimal and come through single precision in results.h5.
constexpr double k_same_size = 1e-6;

}  // namespace

DustRule::DustRule(DustSpec spec, std::vector<double> coarse_graining)
    : spec_(std::move(spec)), coarse_graining_(std::move(coarse_graining)) {}

bool DustRule::takes_size(double represented) const {
  const bool is_listed = spec_.classes.empty() ||
                         std::any_of(spec_.classes.begin(), spec_.classes.end(), [&](double size) {
                           return std::abs(represented - size) <= k_same_size * size;
                         });
  return is_listed && represented < spec_.finer_than;
}

bool DustRule::takes_material(std::int64_t material) const {
  return spec_.materials.empty() || std::find(spec_.materials.begin(), spec_.materials.end(),
                                              material) != spec_.materials.end();
}

}  // namespace dust::scenario

// SPDX-License-Identifier: Apache-2.0
#include "run/dust/dust_sides.hpp"

#include "preflight/air/air_passage.hpp"

#include <algorithm>

namespace dust::run {
namespace {

/// Part of a face that an opening may miss or reach beyond by rounding.
constexpr double k_rounding = 1e-9;

}  // namespace

DustSides::DustSides(const scenario::Setup& setup, const Models& models, const fluid::Grid& grid,
                     const std::vector<particles::Opening>& openings)
    : grid_(grid) {
  for (std::size_t o = 0; o < openings.size(); ++o) {
    if (openings[o].side >= 0) mark_opening(static_cast<std::int32_t>(o), openings[o]);
  }
  const preflight::SideModels& sides = models.sides->models();
  for (std::size_t side = 0; side < 6; ++side) {
    holds_grains_[side] = setup.domain.sides[side].grains == scenario::GrainSide::wall;
    lets_out_[side] = outlets_[side].empty() && preflight::passes_air(setup, side, sides);
    if (lets_out_[side]) passed_[side] = preflight::passed_faces(setup, side, sides);
  }
}

void DustSides::mark_opening(std::int32_t number, const particles::Opening& opening) {
  const auto side = static_cast<std::size_t>(opening.side);
  const std::size_t e = (side / 2 + 1) % 3;
  const std::size_t f = (side / 2 + 2) % 3;
  const auto is_covered = [&](std::size_t axis, int cell) {
    const int n = static_cast<int>(axis);
    const double h = grid_.spacing[n];
    const double low = grid_.origin[n] + cell * h;
    return std::min(low + h, opening.max[n]) - std::max(low, opening.min[n]) > k_rounding * h;
  };
  std::vector<std::int32_t>& outlet = outlets_[side];
  outlet.assign(static_cast<std::size_t>(grid_.count[e]) * grid_.count[f], -1);
  for (int b = 0; b < grid_.count[f]; ++b) {
    for (int a = 0; a < grid_.count[e]; ++a) {
      if (!is_covered(e, a) || !is_covered(f, b)) continue;
      outlet[static_cast<std::size_t>(b) * grid_.count[e] + a] = number;
    }
  }
}

bool DustSides::is_passed(std::size_t side, const std::array<int, 3>& cell) const {
  if (passed_[side].empty()) return true;
  // The order of the columns of a side.
  const std::size_t e = side / 2 == 0 ? 1 : 0;
  const std::size_t f = side / 2 == 2 ? 1 : 2;
  return passed_[side][static_cast<std::size_t>(cell[f]) * grid_.count[e] + cell[e]];
}

bool DustSides::settles_on(std::size_t side, const std::array<int, 3>& cell) const {
  if (holds_grains_[side]) return true;
  if (outlets_[side].empty()) return !lets_out_[side] || !is_passed(side, cell);
  const std::size_t e = (side / 2 + 1) % 3;
  const std::size_t f = (side / 2 + 2) % 3;
  return outlets_[side][static_cast<std::size_t>(cell[f]) * grid_.count[e] + cell[e]] < 0;
}

}  // namespace dust::run

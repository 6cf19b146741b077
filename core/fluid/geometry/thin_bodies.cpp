// SPDX-License-Identifier: Apache-2.0
#include "fluid/geometry/thin_bodies.hpp"

#include "fluid/geometry/wrapped.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::fluid {
namespace {

using sdk::Vec3;

std::size_t at(std::ptrdiff_t index) { return static_cast<std::size_t>(index); }

}  // namespace

void ThinBodies::set(const Geometry& geometry) {
  faces_ = geometry.blocked;
  cells_.clear();
  near_.clear();
  if (faces_.empty()) return;
  near_.assign(grid_.size, k_none);
  const auto enter = [&](const Indices& cell) -> Cell* {
    Indices inside = cell;
    for (int d = 0; d < 3; ++d) {
      if (grid_.is_periodic[d]) inside[d] = wrapped(cell[d], grid_.count[d]);
      if (inside[d] < 0 || inside[d] >= grid_.count[d]) return nullptr;
    }
    std::int32_t& place = near_[at(grid_.index(inside[0], inside[1], inside[2]))];
    if (place == k_none) {
      place = static_cast<std::int32_t>(cells_.size());
      cells_.emplace_back();
    }
    return &cells_[static_cast<std::size_t>(place)];
  };
  for (std::size_t n = 0; n < faces_.size(); ++n) {
    const auto place = static_cast<std::int32_t>(n);
    const auto d = static_cast<std::size_t>(faces_[n].axis);
    const Indices& upper = faces_[n].upper;
    Indices lower = upper;
    --lower[d];
    enter(upper)->face[2 * d] = place;
    enter(lower)->face[2 * d + 1] = place;
    // Those round about interpolate across the face.
    for (int k = -1; k <= 1; ++k) {
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          enter({upper[0] + i, upper[1] + j, upper[2] + k});
          enter({lower[0] + i, lower[1] + j, lower[2] + k});
        }
      }
    }
  }
}

ThinBodies::Indices ThinBodies::indices(Vec3 point) const {
  Indices cell = grid_.cell_at(point);
  for (int d = 0; d < 3; ++d) {
    if (grid_.is_periodic[d]) cell[static_cast<std::size_t>(d)] = grid_.layer_of(d, point[d]);
  }
  return cell;
}

std::int32_t ThinBodies::cell_at(const Indices& cell) const {
  Indices inside = cell;
  for (std::size_t d = 0; d < 3; ++d) {
    if (grid_.is_periodic[d]) inside[d] = wrapped(cell[d], grid_.count[d]);
    if (inside[d] < 0 || inside[d] >= grid_.count[d]) return k_none;
  }
  return near_[at(grid_.index(inside[0], inside[1], inside[2]))];
}

bool ThinBodies::is_blocked(const Indices& cell, int axis, int step) const {
  const std::int32_t place = cell_at(cell);
  if (place == k_none) return false;
  const int side = 2 * axis + (step > 0 ? 1 : 0);
  return cells_[static_cast<std::size_t>(place)].face[static_cast<std::size_t>(side)] != k_none;
}

/// [m] of the point over the middle of the body, towards the upper cell.
double ThinBodies::height_over(Vec3 point, const BlockedFace& face) const {
  Vec3 way = point - face.middle;
  for (int d = 0; d < 3; ++d) {
    if (!grid_.is_periodic[d]) continue;
    const double period = grid_.count[d] * grid_.spacing[d];
    way[d] -= period * std::round(way[d] / period);
  }
  return dot(way, face.normal);
}

/// The cell whose fluid is at the point: its own, or of the neighbours across the body the nearest.
ThinBodies::Indices ThinBodies::cell_of(Vec3 point, const Indices& own) const {
  const Cell& cell = cells_[static_cast<std::size_t>(cell_at(own))];
  double shortest = std::numeric_limits<double>::infinity();
  Indices best = own;
  for (std::size_t side = 0; side < 6; ++side) {
    if (cell.face[side] == k_none) continue;
    const BlockedFace& face = faces_[static_cast<std::size_t>(cell.face[side])];
    const int step = side % 2 == 0 ? -1 : 1;
    if (!(step * height_over(point, face) > 0.0)) continue;
    Indices neighbour = own;
    neighbour[side / 2] += step;
    const double way = norm(grid_.centre(neighbour[0], neighbour[1], neighbour[2]) - point);
    if (way >= shortest) continue;
    shortest = way;
    best = neighbour;
  }
  return best;
}

/// Whether the corner cell `step` away lies beyond a body: all ways to it from its neighbours are
/// blocked.
bool ThinBodies::is_corner_blocked(const Indices& cell, const Indices& step) const {
  for (std::size_t d = 0; d < 3; ++d) {
    if (step[d] == 0) continue;
    Indices before = cell;
    for (std::size_t e = 0; e < 3; ++e) before[e] += e == d ? 0 : step[e];
    if (!is_blocked(before, static_cast<int>(d), step[d])) return false;
  }
  return true;
}

Vec3 ThinBodies::moved(Vec3 point, const Indices& own) const {
  const Indices cell = cell_of(point, own);
  if (cell_at(cell) == k_none) return point;
  const Vec3 centre = grid_.centre(cell[0], cell[1], cell[2]);
  Indices step{};  // towards the neighbours that it is interpolated with
  for (int d = 0; d < 3; ++d) {
    const double way = point[d] - centre[d];
    step[static_cast<std::size_t>(d)] = way < 0.0 ? -1 : way > 0.0 ? 1 : 0;
  }
  // Where a cell of those lies beyond, the point goes to the centre along the axis on which it is
  // nearest to it: first by the faces, then by the edges, then by the corner.
  constexpr std::array<std::array<int, 3>, 7> k_ways = {
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}}};
  for (const auto& way : k_ways) {
    Indices corner{};
    bool is_reached = true;
    int nearest = -1;
    double shift = 1.0;
    for (std::size_t d = 0; d < 3; ++d) {
      if (way[d] == 0) continue;
      corner[d] = step[d];
      is_reached = is_reached && step[d] != 0;
      const int axis = static_cast<int>(d);
      const double needed = std::abs(point[axis] - centre[axis]) / grid_.spacing[axis];
      if (nearest >= 0 && needed >= shift) continue;
      nearest = axis;
      shift = needed;
    }
    if (!is_reached || !is_corner_blocked(cell, corner)) continue;
    point[nearest] = centre[nearest];
    step[static_cast<std::size_t>(nearest)] = 0;
  }
  return point;
}

}  // namespace dust::fluid

// SPDX-License-Identifier: Apache-2.0
#include "fluid/pressure/ghost_pressure.hpp"

#include <algorithm>
#include <array>

namespace dust::fluid {
namespace {

/// A face that fluid may pass: where its number stands, and the cell behind it (-1: outside).
struct Passage {
  int d;
  std::ptrdiff_t face;
  std::ptrdiff_t neighbour;
};

/// Calls f(passage) for the faces of cell c that fluid may pass.
template <class F>
void each_passage(const Grid& grid, const FaceField& pattern, const std::array<int, 3>& c,
                  const F& f) {
  const std::ptrdiff_t o = grid.index(c[0], c[1], c[2]);
  for (int d = 0; d < 3; ++d) {
    const std::ptrdiff_t row = grid.count[d] * grid.stride[d];
    const bool is_first = c[d] == 0;
    const bool is_last = c[d] + 1 == grid.count[d];
    const bool is_periodic = grid.is_periodic[d];
    if (pattern.component[d][o] > 0.0) {
      const std::ptrdiff_t lower = o - grid.stride[d];
      f(Passage{d, o, !is_first ? lower : is_periodic ? lower + row : -1});
    }
    // The last face of a periodic row is its first one.
    const std::ptrdiff_t upper = o + grid.stride[d] - (is_last && is_periodic ? row : 0);
    if (pattern.component[d][upper] > 0.0) {
      f(Passage{d, upper, !is_last || is_periodic ? upper : -1});
    }
  }
}

}  // namespace

void GhostPressure::find(const Grid& grid, const Geometry& geometry, const FaceField& pattern) {
  means_.clear();
  neighbours_.clear();
  std::vector<std::array<int, 3>> left;
  std::vector<char> is_held(grid.size, 1);
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      for (int i = 0; i < grid.count[0]; ++i) {
        const std::ptrdiff_t o = grid.index(i, j, k);
        if (geometry.open_fraction[o] == 1.0) continue;
        bool has_passage = false;
        bool has_unknown = false;
        each_passage(grid, pattern, {i, j, k}, [&](const Passage& p) {
          has_passage = true;
          has_unknown = has_unknown || is_unknown(geometry.kind[p.d][p.face]);
        });
        is_held[o] = has_unknown ? 1 : 0;
        if (has_passage && !has_unknown) left.push_back({i, j, k});
      }
    }
  }
  std::vector<std::ptrdiff_t> found;
  do {
    found.clear();
    std::erase_if(left, [&](const std::array<int, 3>& c) {
      const auto begin = neighbours_.size();
      each_passage(grid, pattern, c, [&](const Passage& p) {
        if (p.neighbour < 0 || is_held[p.neighbour] == 0) return;
        neighbours_.push_back(static_cast<std::int32_t>(p.neighbour));
      });
      if (neighbours_.size() == begin) return false;
      found.push_back(grid.index(c[0], c[1], c[2]));
      means_.push_back({static_cast<std::int32_t>(found.back()), static_cast<std::int32_t>(begin)});
      return true;
    });
    for (const std::ptrdiff_t o : found) is_held[o] = 1;
  } while (!found.empty());
  means_.push_back({-1, static_cast<std::int32_t>(neighbours_.size())});
}

void GhostPressure::fill(CellField& pressure) const {
  for (std::size_t n = 0; n + 1 < means_.size(); ++n) {
    double sum = 0.0;
    for (auto m = means_[n].begin; m < means_[n + 1].begin; ++m) {
      sum += pressure[static_cast<std::size_t>(neighbours_[static_cast<std::size_t>(m)])];
    }
    pressure[static_cast<std::size_t>(means_[n].at)] =
        sum / (means_[n + 1].begin - means_[n].begin);
  }
}

}  // namespace dust::fluid

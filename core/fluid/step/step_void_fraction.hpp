// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/face_properties.hpp"
#include "fluid/grid.hpp"
#include "fluid/parallel.hpp"
#include "fluid/sides.hpp"

namespace dust::fluid {

/// The void fraction at an instant of a fluid step, between those at its ends, halos filled.
class StepVoidFraction {
 public:
  explicit StepVoidFraction(const Grid& grid) : eps_(grid.size, 1.0) {}

  [[nodiscard]] const CellField& field() const { return eps_; }
  /// At the `share` [-] of the step. `is_clean`: it is 1 in all cells at both ends.
  void set(const Grid& grid, const Sides& sides, const CellField& before, const CellField& after,
           double share, bool is_clean, FaceProperties& properties) {
    if (is_clean && is_one_) return;
    is_one_ = is_clean;
    for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < grid.count[0]; ++i) {
        eps_[o + i] = (1.0 - share) * before[o + i] + share * after[o + i];
      }
    });
    sides.fill_cells(eps_);
    if (properties.momentum_set() == MomentumSet::three) properties.set_void_fraction(eps_);
  }
  /// Gives its field away for another of the same size, to be set anew.
  void give_away(CellField& other) {
    eps_.swap(other);
    is_one_ = false;
  }

 private:
  CellField eps_;
  bool is_one_ = false;  ///< now, halos included
};

}  // namespace dust::fluid

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"

#include <cstdint>
#include <vector>

namespace dust::fluid {

/// The pressure of cells that fluid passes through ghost faces only: slivers beside a surface, open
/// by a few per cent. The velocity of a ghost face mirrors the fluid's, whatever the pressure, so
/// that each projection corrects it by the same increment, and the sum of these would grow without
/// end. No unknown velocity sees such a pressure; grains and walls do. It is the mean of the
/// neighbours that fluid passes to; docs/theory/fluid.md, eq. (6).
class GhostPressure {
 public:
  /// Finds the cells after the grid was cut. `pattern`: faces that fluid may pass and whose flux
  /// the pressure can change.
  void find(const Grid& grid, const Geometry& geometry, const FaceField& pattern);
  /// `pressure` [Pa] of the cells found.
  void fill(CellField& pressure) const;

 private:
  /// A cell and the neighbours that its pressure is the mean of, from `begin` on.
  struct Mean {
    std::int32_t at;
    std::int32_t begin;
  };
  std::vector<Mean> means_;  ///< in rounds from the cells with unknowns on, and a last one
  std::vector<std::int32_t> neighbours_;
};

}  // namespace dust::fluid

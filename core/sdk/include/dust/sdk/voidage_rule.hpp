// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/columns.hpp"
#include "dust/sdk/grid_shape.hpp"
#include "dust/sdk/model.hpp"
#include "dust/sdk/vec3.hpp"

#include <cstdint>
#include <span>

namespace dust::sdk {

/// The cells a grain's volume is spread over, one grain after another. Grains near a periodic side
/// may name cells outside [0, count); the core wraps them.
struct VoidageBatch {
  std::size_t count = 0;
  VectorColumns position;          ///< [m] of the centres
  const double* radius = nullptr;  ///< [m]
  int capacity = 0;                ///< rows per grain in the output
  int* used = nullptr;             ///< out: cells of grain g, <= capacity
  int* cell_i = nullptr;  ///< out: [g * capacity + n] cell indices, may lie outside the grid
  int* cell_j = nullptr;
  int* cell_k = nullptr;
  double* weight = nullptr;  ///< out: share of the grain's volume, sums to 1 per grain
};

/// Spreads grain volumes over cells. Contract: the weights of a grain sum to 1 to rounding. Shares
/// that fall outside the domain or into a body are given back to open cells by the core.
class VoidageRule : public Model {
 public:
  static constexpr const char* k_kind = "voidage";
  /// Largest number of cells a grain of `radius` [m] can touch on `grid`.
  [[nodiscard]] virtual int capacity(const GridShape& grid, double radius) const = 0;
  /// Largest D/dx the rule is valid for; beyond it the core refuses the scenario.
  [[nodiscard]] virtual double largest_diameter_over_spacing() const = 0;
  virtual void spread(const GridShape& grid, const VoidageBatch& batch) const = 0;
  /// Distance from the centre [m], along an axis, beyond which a grain of `radius` [m] gives
  /// nothing. Cells that reach nearer may get a share.
  [[nodiscard]] virtual Vec3 reach(const GridShape& /*grid*/, double radius) const {
    return {radius, radius, radius};
  }
};

}  // namespace dust::sdk

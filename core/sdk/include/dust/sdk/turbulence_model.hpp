// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"

#include <cstddef>

namespace dust::sdk {

/// Columns of `count` fluid cells.
struct TurbulenceBatch {
  std::size_t count = 0;
  double filter_width = 0.0;              ///< [m] Delta = (dx dy dz)^(1/3) over the directions
                                          ///< with more than one cell
  const double* strain_rate = nullptr;    ///< [1/s] |S| = sqrt(2 S_ij S_ij) of the resolved flow
  const double* wall_distance = nullptr;  ///< [m] to the nearest wall at which the fluid sticks
  const double* density = nullptr;        ///< [kg/m3]
  const double* viscosity = nullptr;      ///< [Pa s] molecular
  double* eddy_viscosity = nullptr;       ///< [Pa s] out, >= 0
};

/// Closure of the motion smaller than a cell by an eddy viscosity:
/// \f$ \tau_{ij} = 2 (\mu + \mu_t) S_{ij} \f$. Must not: allocate, keep state, know the grid.
/// Called from several threads at once.
class TurbulenceModel : public Model {
 public:
  static constexpr const char* k_kind = "turbulence";
  virtual void evaluate(const TurbulenceBatch& batch) const = 0;
};

}  // namespace dust::sdk

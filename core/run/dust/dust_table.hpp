// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/dust_field.hpp"
#include "dust/sdk/airborne_dust.hpp"
#include "fluid/grid.hpp"

#include <span>
#include <vector>

namespace dust::run {

/// The concentrations of a dust field as sensors see them: copies, x fastest.
class DustTable {
 public:
  /// `density` [kg/m3] of the dust itself.
  DustTable(const fluid::Grid& grid, std::vector<double> diameters, double density);

  /// Copies the field; `volume` as DustField::concentration has it.
  void take(const airborne::DustField& field, const fluid::CellField& volume);
  /// Valid until the next copy.
  [[nodiscard]] sdk::DustColumns columns() const { return {diameters_, density_, spans_}; }

 private:
  fluid::Grid grid_;
  std::vector<double> diameters_;
  double density_;
  fluid::CellField concentration_;  ///< of one class
  std::vector<std::vector<float>> columns_;
  std::vector<std::span<const float>> spans_;
};

}  // namespace dust::run

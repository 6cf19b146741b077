// SPDX-License-Identifier: Apache-2.0
#include "coupling/drag/drag_model.hpp"

#include <algorithm>

namespace dust::coupling {
namespace {

/// Relative change of the Reynolds number by which the slope of a drag law is found.
constexpr double k_reynolds_change = 0.01;

}  // namespace

DragModel::DragModel(const sdk::DragLaw& law, const scenario::FluidSpec& fluid,
                     const fluid::Grid& grid, std::span<const scenario::MaterialSpec> materials)
    : law_(law),
      properties_(fluid, grid.origin, grid.period()),
      own_per_kinematic_viscosity_(properties_.own().density / properties_.own().viscosity),
      graining_(materials),
      set_(fluid::momentum_set_of(fluid.momentum_set)),
      needs_size_ratio_(law.needs_size_ratio()) {}

void DragModel::find_slope(DragColumns& columns, std::size_t count, double* slope) const {
  StencilBatch::Reals factor;
  for (std::size_t q = 0; q < count; ++q) {
    factor[q] = columns.factor[q];
    columns.reynolds[q] *= 1.0 + k_reynolds_change;
  }
  evaluate(columns, count);
  for (std::size_t q = 0; q < count; ++q) {
    // A law of beds may end at 0 for a grain at rest that is alone in its cell.
    const double growth = factor[q] > 0.0 ? columns.factor[q] / factor[q] - 1.0 : 0.0;
    slope[q] = std::clamp(growth * (1.0 / k_reynolds_change), 0.0, 1.0);
  }
}

double DragModel::fastest_relaxation(const particles::GrainRows& grains) const {
  double fastest = 0.0;
  for (std::size_t row = 0; row < grains.count; ++row) {
    fastest = std::max(fastest, coefficient(grains, row, 1.0) * grains.inverse_mass(row));
  }
  return fastest;
}

}  // namespace dust::coupling

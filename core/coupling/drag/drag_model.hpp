// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/coarse_graining.hpp"
#include "coupling/stencils/face_kernels.hpp"
#include "dust/sdk/drag_law.hpp"
#include "fluid/grid.hpp"
#include "fluid/momentum_set.hpp"
#include "fluid/properties.hpp"
#include "particles/grain_rows.hpp"
#include "setup/setup.hpp"

#include <array>
#include <cstddef>
#include <numbers>
#include <span>

namespace dust::coupling {

/// What a drag law reads and writes for a batch of particles, as columns.
struct DragColumns {
  std::array<double, StencilBatch::k_size> reynolds, void_fraction, factor, size_ratio;
};

/// The drag law with the fluid's properties: drag coefficients of particles, K = 3 pi mu D F.
class DragModel {
 public:
  using Fluid = fluid::Properties::Values;

  /// `law` is kept by reference.
  DragModel(const sdk::DragLaw& law, const scenario::FluidSpec& fluid, const fluid::Grid& grid,
            std::span<const scenario::MaterialSpec> materials);

  [[nodiscard]] fluid::MomentumSet momentum_set() const { return set_; }
  [[nodiscard]] bool is_set_three() const { return set_ == fluid::MomentumSet::three; }
  [[nodiscard]] bool needs_size_ratio() const { return needs_size_ratio_; }
  [[nodiscard]] const fluid::Properties& properties() const { return properties_; }
  [[nodiscard]] const CoarseGraining& graining() const { return graining_; }

  [[nodiscard]] Fluid fluid_at(const double* position) const {
    if (properties_.is_uniform()) return properties_.own();
    return properties_.at({position[0], position[1], position[2]});
  }
  /// Reynolds number of the particles that a computed one stands for.
  [[nodiscard]] double reynolds(const particles::GrainRows& grains, std::size_t row, double eps,
                                double slip) const {
    return eps * slip * grains.diameter(row) * per_kinematic_viscosity(grains.position_of(row)) /
           graining_.of(grains, row);
  }
  /// K = 3 pi mu D F [kg/s]: of l^3 particles of diameter D / l, l^2 times as much.
  [[nodiscard]] double coefficient(const particles::GrainRows& grains, std::size_t row,
                                   double factor) const {
    const double l = graining_.of(grains, row);
    const double viscosity = fluid_at(grains.position_of(row)).viscosity;
    return 3.0 * std::numbers::pi * viscosity * grains.diameter(row) * factor * (l * l);
  }
  /// Set III puts the pressure's part into the drag; docs/theory/coupling.md, eq. (3).
  [[nodiscard]] double factor_of_set(double eps) const { return is_set_three() ? 1.0 / eps : 1.0; }

  /// F of the first `count` particles, from their Reynolds numbers and void fractions.
  void evaluate(DragColumns& columns, std::size_t count) const {
    law_.evaluate({count, columns.reynolds.data(), columns.void_fraction.data(),
                   columns.factor.data(), needs_size_ratio_ ? columns.size_ratio.data() : nullptr});
  }
  /// Logarithmic slope d ln F / d ln Re at the present factors: 0 for a viscous drag, 1 for one of
  /// inertia; 0 where there is no drag. Overwrites factors and Reynolds numbers.
  void find_slope(DragColumns& columns, std::size_t count, double* slope) const;
  /// Largest rate of relaxation [1/s] of the particles in Stokes's drag, 3 pi mu D / m.
  [[nodiscard]] double fastest_relaxation(const particles::GrainRows& grains) const;

 private:
  /// Density over viscosity [s/m2] at a position.
  [[nodiscard]] double per_kinematic_viscosity(const double* position) const {
    if (properties_.is_uniform()) return own_per_kinematic_viscosity_;
    const Fluid fluid = fluid_at(position);
    return fluid.density / fluid.viscosity;
  }

  const sdk::DragLaw& law_;
  fluid::Properties properties_;
  double own_per_kinematic_viscosity_;  ///< [s/m2] of the uniform fluid
  CoarseGraining graining_;
  fluid::MomentumSet set_;
  bool needs_size_ratio_;
};

}  // namespace dust::coupling

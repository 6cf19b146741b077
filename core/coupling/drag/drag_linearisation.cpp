// SPDX-License-Identifier: Apache-2.0
#include "coupling/drag/drag_linearisation.hpp"

#include <algorithm>
#include <cmath>

namespace dust::coupling {
namespace {

/// Least part of the true drag coefficient given to the fluid. The mean drag of a free particle
/// falls short of it when the particle follows the fluid within the step; one held by its
/// neighbours feels it in full, and what the fluid was not given comes one step late. That is
/// stable only if the late part is the smaller one: the part must exceed 1/2, and 2/3 where the
/// fluid takes many sub-steps.
constexpr double k_min_implicit = 0.7;

/// The same where the particles' cycle overlaps the fluid's step. What particles receive is then
/// that of the step before: errors of a held one follow h x^2 - h x + 1 = 0, |x|^2 = 1/h, so that
/// the fluid must be given more than the true coefficient (the rest of the residual is taken back).
/// Free particles are stable from 1 to 4.
constexpr double k_overlapped_implicit = 2.0;

}  // namespace

DragLinearisation::DragLinearisation(const CouplingScene& scene, SelfDisturbance& self,
                                     const Triple& initial_velocity, Order order)
    : lattice_(scene.lattice),
      voidage_(scene.voidage),
      drag_(scene.drag),
      void_fraction_(scene.void_fraction),
      self_(self),
      states_(scene.states),
      initial_velocity_(initial_velocity),
      order_(order) {}

/// Part of the coefficient that the fluid is given. A free particle relaxes within the step: mean
/// drag by docs/theory/coupling.md, eq. (13), (14), `relaxations` = K step / m.
double DragLinearisation::implicit_factor(double relaxations) const {
  // A law of beds may end at 0 for a grain that is alone and at rest in the fluid.
  const double mean = relaxations > 0.0 ? -std::expm1(-relaxations) / relaxations : 1.0;
  return order_ == Order::overlapped ? k_overlapped_implicit : std::max(mean, k_min_implicit);
}

/// The slip of each particle with the fluid last seen at it (the initial velocity for a new one).
void DragLinearisation::find_slips(const ParticleBatch& batch, std::size_t number, double step,
                                   LinearisedDrag& drag, DragColumns& columns) {
  const particles::GrainRows& grains = batch.grains;
  MultiCellKernel multi_cell(lattice_, voidage_);
  SmoothKernel smooth(lattice_);
  for (std::size_t q = 0; q < batch.size(); ++q) {
    const std::size_t row = batch.row(q);
    const double* position = grains.position_of(row);
    const double* velocity = grains.velocity_of(row);
    ParticleState& r = states_[row];
    r.stencil = static_cast<std::int32_t>(number * StencilBatch::k_size + q);
    if (!r.has_velocity) r.fluid_velocity = initial_velocity_;
    double slip = 0.0;
    for (int d = 0; d < 3; ++d) {
      slip += (r.fluid_velocity[d] - velocity[d]) * (r.fluid_velocity[d] - velocity[d]);
    }
    slip = std::sqrt(slip);
    double& around = drag.void_fraction[q];
    around = void_fraction_.around(position, cell_of(batch.here, q), multi_cell);
    drag.is_smooth[q] = 0;
    if (states_.has_self_flow()) {
      drag.is_smooth[q] = self_.begin_step(grains, row, slip, step, smooth, around) ? 1 : 0;
    }
    columns.void_fraction[q] = around;
    columns.reynolds[q] = drag_.reynolds(grains, row, around, slip);
    columns.size_ratio[q] = r.size_ratio;
  }
}

void DragLinearisation::evaluate(const ParticleBatch& batch, std::size_t number, double step,
                                 LinearisedDrag& drag) {
  const particles::GrainRows& grains = batch.grains;
  DragColumns columns;
  find_slips(batch, number, step, drag, columns);
  drag_.evaluate(columns, batch.size());
  for (std::size_t q = 0; q < batch.size(); ++q) {
    const std::size_t row = batch.row(q);
    const double inverse_mass = grains.inverse_mass(row);
    // The faces' coefficients hold the set's factor already.
    const double of_faces =
        drag_.coefficient(grains, row, columns.factor[q]) / self_.stress_factor(row);
    const double of_particle = of_faces * drag_.factor_of_set(columns.void_fraction[q]);
    drag.coefficient[q] = of_faces * implicit_factor(of_particle * inverse_mass * step);
  }
  drag_.find_slope(columns, batch.size(), drag.slope.data());
  // There is no tangent where no fluid has been seen yet.
  for (std::size_t q = 0; q < batch.size(); ++q) {
    if (!states_[batch.row(q)].has_velocity) drag.slope[q] = 0.0;
  }
}

}  // namespace dust::coupling

// SPDX-License-Identifier: Apache-2.0
#include "coupling/drag/drag_relaxation.hpp"

#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>

namespace dust::coupling {
namespace {

/// Slip of particle q along d that drag acts on. The ratio differs from 1 only where the void
/// fraction changes. It is applied to the slip half way, because the particle has one rate for all
/// directions.
double relative_slip(const SampledFlow& flow, const DragLookAhead& ahead, std::size_t d,
                     std::size_t q) {
  const double change = ahead.change[d][q];
  return flow.ratio[d][q] * (flow.slip[d][q] - change) + change;
}

/// A law of beds may end at 0 for a grain that is alone and at rest in the fluid: it takes a
/// millionth of its slip in the interval, so that what else acts has a target.
double drag_above_zero(double drag, double mass, double held) {
  constexpr double k_share = 1e-6;
  return drag > 0.0 ? drag : k_share * mass / held;
}

/// The fluid at a particle with this relative slip, for those who ask how hard it blows.
void note_wind(const particles::GrainRows& grains, std::size_t row, const Triple& relative,
               double drag) {
  if (grains.wind == nullptr) return;
  const double* v = grains.velocity_of(row);
  double* wind = grains.wind + 4 * row;
  for (std::size_t d = 0; d < 3; ++d) wind[d] = v[d] + relative[d];
  wind[3] = drag;
}

sdk::VectorColumns columns_of(const std::array<StencilBatch::Reals, 3>& v) {
  return {v[0].data(), v[1].data(), v[2].data()};
}

}  // namespace

DragRelaxation::DragRelaxation(const DragModel& drag, const SelfDisturbance& self,
                               ParticleStates& states, sdk::Vec3 gravity)
    : drag_(drag), self_(self), states_(states), gravity_(gravity) {}

void DragRelaxation::fetch(const particles::GrainRows& grains, Rows rows) const {
  for (const std::int32_t row : rows) {
    states_.prefetch(static_cast<std::size_t>(row));
    __builtin_prefetch(grains.drag_relaxation + 4 * static_cast<std::size_t>(row));
  }
}

/// Particles that have no action yet get that of the drag at their present slip, for `look_ahead`.
void DragRelaxation::begin(const particles::GrainRows& grains, Rows rows, const SampledFlow& flow,
                           DragColumns& columns) const {
  const auto is_new = [&](std::int32_t row) {
    return !states_[static_cast<std::size_t>(row)].has_velocity;
  };
  if (std::none_of(rows.begin(), rows.end(), is_new)) return;
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const Triple slip{flow.slip[0][q], flow.slip[1][q], flow.slip[2][q]};
    const double speed = std::sqrt(slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]);
    const auto row = static_cast<std::size_t>(rows[q]);
    columns.reynolds[q] = drag_.reynolds(grains, row, columns.void_fraction[q], speed);
    columns.size_ratio[q] = states_[row].size_ratio;
  }
  drag_.evaluate(columns, rows.size());
  for (std::size_t q = 0; q < rows.size(); ++q) {
    if (!is_new(rows[q])) continue;
    const auto row = static_cast<std::size_t>(rows[q]);
    const double* v = grains.velocity_of(row);
    double* action = grains.drag_relaxation + 4 * row;
    for (std::size_t d = 0; d < 3; ++d) action[d] = v[d] + flow.slip[d][q];
    action[3] = drag_.coefficient(grains, row, columns.factor[q]) * v[3];
  }
}

/// The change of each grain's velocity until half way, and the batch's Reynolds numbers then.
void DragRelaxation::look_ahead(const particles::GrainRows& grains, Rows rows, double held,
                                double last_held, const SampledFlow& flow, DragColumns& columns,
                                DragLookAhead& ahead) {
  begin(grains, rows, flow, columns);
  const double half = 0.5 * held;
  const double before = last_held > 0.0 ? half / last_held : 0.0;
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    const double* v = grains.velocity_of(row);
    const double* action = grains.drag_relaxation + 4 * row;
    ParticleState& r = states_[row];
    const bool is_known = r.has_velocity && before > 0.0;
    ahead.rate[q] = action[3];
    ahead.is_known[q] = is_known ? 1.0 : 0.0;
    // Of a new grain only the drag is known; its weight may be borne by what else acts on it.
    const double volume = sdk::sphere_volume(2.0 * grains.position[4 * row + 3]);
    ahead.weight[q] = is_known ? weight_factor(v[3], volume) : 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      ahead.pull[d][q] = action[d] - v[d];
      ahead.change[d][q] = v[d] - r.velocity[d];
      r.velocity[d] = v[d];
      r.fluid_velocity[d] = v[d] + flow.slip[d][q];
    }
    r.has_velocity = true;
    columns.size_ratio[q] = r.size_ratio;
  }
  predict(rows.size(), half, before, {gravity_.x, gravity_.y, gravity_.z}, flow.slip, ahead);
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    columns.reynolds[q] = drag_.reynolds(grains, row, columns.void_fraction[q], ahead.speed[q]);
  }
}

void DragRelaxation::update(const particles::GrainRows& grains, Rows rows, const FluidState& fluid,
                            const SampledFlow& flow, double held, double last_held,
                            DragColumns& columns) {
  DragLookAhead ahead;
  look_ahead(grains, rows, held, last_held, flow, columns, ahead);
  drag_.evaluate(columns, rows.size());
  if (forces_ != nullptr) {
    relax_by_forces(grains, rows, fluid, flow, held, ahead, columns);
  } else {
    relax_by_drag(grains, rows, flow, held, ahead, columns);
  }
}

/// Drag and the stress on the particle's volume.
void DragRelaxation::relax_by_drag(const particles::GrainRows& grains, Rows rows,
                                   const SampledFlow& flow, double held, const DragLookAhead& ahead,
                                   const DragColumns& columns) {
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    const double diameter = 2.0 * grains.position[4 * row + 3];
    const double* v = grains.velocity_of(row);
    double* action = grains.drag_relaxation + 4 * row;
    ParticleState& r = states_[row];
    const DragModel::Fluid fluid = drag_.fluid_at(grains.position + 4 * row);
    const double drag =
        drag_above_zero(drag_coefficient(grains, row, columns, q), 1.0 / v[3], held);
    const double per_drag = 1.0 / drag;
    const double volume = sdk::sphere_volume(diameter);
    // The particles' reduced gravity is that of the fluid's own density.
    const double lift = volume * (drag_.properties().own().density - fluid.density);
    Triple relative;
    for (std::size_t d = 0; d < 3; ++d) {
      const double force =
          volume * flow.stress[d][q] + (lift == 0.0 ? 0.0 : lift * gravity_[static_cast<int>(d)]);
      relative[d] = relative_slip(flow, ahead, d, q);
      action[d] = v[d] + relative[d] + force * per_drag;
      r.stress_impulse[d] += force;
    }
    action[3] = drag * v[3];
    note_wind(grains, row, relative, drag);
  }
}

void DragRelaxation::relax_by_forces(const particles::GrainRows& grains, Rows rows,
                                     const FluidState& fluid, const SampledFlow& flow, double held,
                                     const DragLookAhead& ahead, const DragColumns& columns) {
  ForceModels::Sums sums;
  const ForceModels::Batch terms{rows, columns.void_fraction.data(), columns_of(flow.slip),
                                 columns_of(flow.stress)};
  forces_->evaluate(grains, terms, fluid, held, states_, sums);
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    const double mass = 1.0 / grains.velocity_of(row)[3];
    const double drag = drag_above_zero(drag_coefficient(grains, row, columns, q), mass, held);
    Triple relative;
    for (std::size_t d = 0; d < 3; ++d) relative[d] = relative_slip(flow, ahead, d, q);
    act(grains, row, q, drag, relative, held, sums);
    note_wind(grains, row, relative, drag);
  }
}

/// With forces besides drag (docs/theory/coupling.md, eq. (21)) the grain obeys
///   (m + m_a) dv/dt = K (relative slip) + sum of forces + m g' + contacts ,
/// while the DEM integrates dv/dt = rate (target - v) + g' + contacts / m: the target makes up for
/// the difference, for the contacts with those of the last interval.
void DragRelaxation::act(const particles::GrainRows& grains, std::size_t row, std::size_t n,
                         double drag_coefficient, const Triple& relative, double held,
                         const ForceModels::Sums& sums) {
  const double* v = grains.velocity_of(row);
  double* action = grains.drag_relaxation + 4 * row;
  ParticleState& r = states_[row];
  const double mass = 1.0 / v[3];
  const double moved = mass + sums.added_mass[n];
  const double volume = sdk::sphere_volume(2.0 * grains.position[4 * row + 3]);
  const double share = forces_->weight_share(mass, volume);
  const bool is_buoyancy_taken = forces_->taken().buoyancy;
  const double lift = is_buoyancy_taken
                          ? 0.0
                          : volume * (drag_.properties().own().density -
                                      drag_.fluid_at(grains.position + 4 * row).density);
  Triple pull;       // [N] all but m g' and contacts
  Triple contained;  // [N] of it, what the fluid does not receive
  for (std::size_t d = 0; d < 3; ++d) {
    const double g = gravity_[static_cast<int>(d)];
    contained[d] = volume * sums.kept[n][d] + lift * g + sums.contained[n][d];
    pull[d] = drag_coefficient * relative[d] + contained[d] + sums.returned[n][d] -
              sums.added_mass[n] * (share * g + sums.contact[n][d]);
  }
  if (sums.resistance[n] > 0.0) {
    // Implicit along the wall's normal: it may be far stiffer than the interval.
    double approach = -sums.wall_speed[n];
    double change = 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double towards = sums.normal[n][d];
      approach += towards * v[d];
      change += towards * (pull[d] / moved + share * gravity_[static_cast<int>(d)]) * held;
    }
    const double stiffness = sums.resistance[n] * held / moved;
    const double force = -sums.resistance[n] * (approach + change) / (1.0 + stiffness);
    for (std::size_t d = 0; d < 3; ++d) {
      pull[d] += force * sums.normal[n][d];
      contained[d] += force * sums.normal[n][d];
    }
  }
  for (std::size_t d = 0; d < 3; ++d) {
    action[d] = v[d] + pull[d] / drag_coefficient;
    r.stress_impulse[d] += contained[d];
  }
  action[3] = drag_coefficient / moved;
}

}  // namespace dust::coupling

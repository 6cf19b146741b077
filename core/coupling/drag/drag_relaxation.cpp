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
void DragRelaxation::begin(const ParticleBatch& batch, const SampledFlow& flow,
                           DragColumns& columns) const {
  const particles::GrainRows& grains = batch.grains;
  const auto is_new = [&](std::int32_t row) {
    return !states_[static_cast<std::size_t>(row)].has_velocity;
  };
  if (std::none_of(batch.rows.begin(), batch.rows.end(), is_new)) return;
  for (std::size_t q = 0; q < batch.size(); ++q) {
    const Triple slip{flow.slip[0][q], flow.slip[1][q], flow.slip[2][q]};
    const double speed = std::sqrt(slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]);
    const std::size_t row = batch.row(q);
    columns.reynolds[q] = drag_.reynolds(grains, row, columns.void_fraction[q], speed);
    columns.size_ratio[q] = states_[row].size_ratio;
  }
  drag_.evaluate(columns, batch.size());
  for (std::size_t q = 0; q < batch.size(); ++q) {
    if (!is_new(batch.rows[q])) continue;
    const std::size_t row = batch.row(q);
    const double* v = grains.velocity_of(row);
    double* action = grains.drag_relaxation + 4 * row;
    for (std::size_t d = 0; d < 3; ++d) action[d] = v[d] + flow.slip[d][q];
    action[3] = drag_.coefficient(grains, row, columns.factor[q]) * grains.inverse_mass(row);
  }
}

/// The change of each grain's velocity until half way, and the batch's Reynolds numbers then.
void DragRelaxation::look_ahead(const ParticleBatch& batch, const Interval& interval,
                                const SampledFlow& flow, DragColumns& columns,
                                DragLookAhead& ahead) {
  begin(batch, flow, columns);
  const particles::GrainRows& grains = batch.grains;
  const double half = 0.5 * interval.held;
  const double before = interval.last_held > 0.0 ? half / interval.last_held : 0.0;
  for (std::size_t q = 0; q < batch.size(); ++q) {
    const std::size_t row = batch.row(q);
    const double* v = grains.velocity_of(row);
    const double* action = grains.drag_relaxation + 4 * row;
    ParticleState& r = states_[row];
    const bool is_known = r.has_velocity && before > 0.0;
    ahead.rate[q] = action[3];
    ahead.is_known[q] = is_known ? 1.0 : 0.0;
    // Of a new grain only the drag is known; its weight may be borne by what else acts on it.
    const double volume = sdk::sphere_volume(grains.diameter(row));
    ahead.weight[q] = is_known ? weight_factor(grains.inverse_mass(row), volume) : 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      ahead.pull[d][q] = action[d] - v[d];
      ahead.change[d][q] = v[d] - r.velocity[d];
      r.velocity[d] = v[d];
      r.fluid_velocity[d] = v[d] + flow.slip[d][q];
    }
    r.has_velocity = true;
    columns.size_ratio[q] = r.size_ratio;
  }
  predict(batch.size(), half, before, {gravity_.x, gravity_.y, gravity_.z}, flow.slip, ahead);
  for (std::size_t q = 0; q < batch.size(); ++q) {
    const std::size_t row = batch.row(q);
    columns.reynolds[q] = drag_.reynolds(grains, row, columns.void_fraction[q], ahead.speed[q]);
  }
}

void DragRelaxation::update(const ParticleBatch& batch, const FluidState& fluid,
                            const SampledFlow& flow, const Interval& interval,
                            DragColumns& columns) {
  DragLookAhead ahead;
  look_ahead(batch, interval, flow, columns, ahead);
  drag_.evaluate(columns, batch.size());
  if (forces_ != nullptr) {
    relax_by_forces(batch, fluid, flow, interval.held, ahead, columns);
  } else {
    relax_by_drag(batch, flow, interval.held, ahead, columns);
  }
}

/// Drag and the stress on the particle's volume.
void DragRelaxation::relax_by_drag(const ParticleBatch& batch, const SampledFlow& flow, double held,
                                   const DragLookAhead& ahead, const DragColumns& columns) {
  const particles::GrainRows& grains = batch.grains;
  for (std::size_t q = 0; q < batch.size(); ++q) {
    const std::size_t row = batch.row(q);
    const double* v = grains.velocity_of(row);
    double* action = grains.drag_relaxation + 4 * row;
    ParticleState& r = states_[row];
    const DragModel::Fluid fluid = drag_.fluid_at(grains.position_of(row));
    const double drag =
        drag_above_zero(drag_coefficient(grains, row, columns, q), grains.mass(row), held);
    const double per_drag = 1.0 / drag;
    const double volume = sdk::sphere_volume(grains.diameter(row));
    // The particles' reduced gravity is that of the fluid's own density.
    const double lift = volume * (drag_.properties().own().density - fluid.density);
    Triple relative;
    for (std::size_t d = 0; d < 3; ++d) {
      const double force =
          volume * flow.stress[d][q] + (lift == 0.0 ? 0.0 : lift * gravity_[static_cast<int>(d)]);
      relative[d] = relative_slip(flow, ahead, d, q);
      action[d] = v[d] + relative[d] + force * per_drag;
      r.stress_impulse[d] += held * force;
    }
    action[3] = drag * grains.inverse_mass(row);
    note_wind(grains, row, relative, drag);
  }
}

void DragRelaxation::relax_by_forces(const ParticleBatch& batch, const FluidState& fluid,
                                     const SampledFlow& flow, double held,
                                     const DragLookAhead& ahead, const DragColumns& columns) {
  const particles::GrainRows& grains = batch.grains;
  ForceModels::Sums sums;
  const ForceModels::Batch terms{batch.rows, columns.void_fraction.data(), columns_of(flow.slip),
                                 columns_of(flow.stress)};
  forces_->evaluate(grains, terms, fluid, held, states_, sums);
  for (std::size_t q = 0; q < batch.size(); ++q) {
    const std::size_t row = batch.row(q);
    const double mass = grains.mass(row);
    const double drag = drag_above_zero(drag_coefficient(grains, row, columns, q), mass, held);
    Triple relative;
    for (std::size_t d = 0; d < 3; ++d) relative[d] = relative_slip(flow, ahead, d, q);
    act(batch, q, drag, relative, held, sums);
    note_wind(grains, row, relative, drag);
  }
}

/// With forces besides drag (docs/theory/coupling.md, eq. (21)) the grain obeys
///   (m + m_a) dv/dt = K (relative slip) + sum of forces + m g' + contacts ,
/// while the DEM integrates dv/dt = rate (target - v) + g' + contacts / m: the target makes up for
/// the difference, for the contacts with those of the last interval.
void DragRelaxation::act(const ParticleBatch& batch, std::size_t q, double drag_coefficient,
                         const Triple& relative, double held, const ForceModels::Sums& sums) {
  const particles::GrainRows& grains = batch.grains;
  const std::size_t row = batch.row(q);
  const double* v = grains.velocity_of(row);
  double* action = grains.drag_relaxation + 4 * row;
  ParticleState& r = states_[row];
  const double mass = grains.mass(row);
  const double moved = mass + sums.added_mass[q];
  const double volume = sdk::sphere_volume(grains.diameter(row));
  const double share = forces_->weight_share(mass, volume);
  const bool is_buoyancy_taken = forces_->taken().buoyancy;
  const double lift = is_buoyancy_taken
                          ? 0.0
                          : volume * (drag_.properties().own().density -
                                      drag_.fluid_at(grains.position_of(row)).density);
  Triple pull;       // [N] all but m g' and contacts
  Triple contained;  // [N] of it, what the fluid does not receive
  for (std::size_t d = 0; d < 3; ++d) {
    const double g = gravity_[static_cast<int>(d)];
    contained[d] = volume * sums.kept[q][d] + lift * g + sums.contained[q][d];
    pull[d] = drag_coefficient * relative[d] + contained[d] + sums.returned[q][d] -
              sums.added_mass[q] * (share * g + sums.contact[q][d]);
  }
  if (sums.resistance[q] > 0.0) {
    // Implicit along the wall's normal: it may be far stiffer than the interval.
    double approach = -sums.wall_speed[q];
    double change = 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double towards = sums.normal[q][d];
      approach += towards * v[d];
      change += towards * (pull[d] / moved + share * gravity_[static_cast<int>(d)]) * held;
    }
    const double stiffness = sums.resistance[q] * held / moved;
    const double force = -sums.resistance[q] * (approach + change) / (1.0 + stiffness);
    for (std::size_t d = 0; d < 3; ++d) {
      pull[d] += force * sums.normal[q][d];
      contained[d] += force * sums.normal[q][d];
    }
  }
  for (std::size_t d = 0; d < 3; ++d) {
    action[d] = v[d] + pull[d] / drag_coefficient;
    r.stress_impulse[d] += held * contained[d];
  }
  action[3] = drag_coefficient / moved;
}

}  // namespace dust::coupling

// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling_impl.hpp"
#include "dust/sdk/sphere.hpp"

#include <tbb/blocked_range.h>

#include <stdexcept>

namespace dust::coupling {

/// What the grains see of the fluid half way through the interval that the action holds for, by
/// their velocity now: slip, what the drag on the grain is of the law's, stress; the batch's
/// Reynolds numbers and void fractions.
void Coupling::Impl::look(const particles::GrainRows& grains, SpotBatch& spot, Rows rows,
                          const FluidState& state, Seen& seen, Batch& batch) {
  if (locate(grains, rows, spot, 0.5 * held(state))) are_spots_of_map = false;
  const bool has_wide = look_into_cells(spot, rows, state, seen, batch);
  std::array<SpotBatch::Reals, 3> v;
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const double* velocity = grains.velocity_of(static_cast<std::size_t>(rows[q]));
    for (std::size_t d = 0; d < 3; ++d) v[d][q] = velocity[d];
  }
  SpotBatch::Reals open;
  SpotBatch::Reals fluid;
  SpotBatch::Reals flux;  // relative to the grain: it does not jump with eps in plug flow
  for (int d = 0; d < 3; ++d) {
    look_at_faces(spot, d, face_void.columns(d), state.velocity.component[d].data(), v[d].data(),
                  {open.data(), fluid.data()}, flux.data());
    if (has_wide) {
      look_wide(spot, d, state, v[d].data(), {open.data(), fluid.data()}, flux.data(),
                seen.stress[d].data());
    }
    double* slip = seen.slip[d].data();
    double* ratio = seen.ratio[d].data();
    slip_of_faces(rows.size(), batch.void_fraction.data(), {open.data(), fluid.data()}, flux.data(),
                  slip, ratio);
    if (is_set_three) std::fill_n(ratio, rows.size(), 1.0);
  }
  if (memory.has_own_flow()) look_smooth(spot, rows, state, v, seen, batch);
}

/// Grains that have no action yet get that of the drag at their present slip, for `look_ahead`.
void Coupling::Impl::begin_action(const particles::GrainRows& grains, Rows rows, const Seen& seen,
                                  Batch& batch) {
  const auto is_new = [&](std::int32_t row) {
    return !memory[static_cast<std::size_t>(row)].has_velocity;
  };
  if (std::none_of(rows.begin(), rows.end(), is_new)) return;
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const Triple slip{seen.slip[0][q], seen.slip[1][q], seen.slip[2][q]};
    const double speed = std::sqrt(slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]);
    const auto row = static_cast<std::size_t>(rows[q]);
    batch.reynolds[q] = reynolds(grains, row, batch.void_fraction[q], speed);
    batch.size_ratio[q] = memory[row].size_ratio;
  }
  evaluate(batch, rows.size());
  for (std::size_t q = 0; q < rows.size(); ++q) {
    if (!is_new(rows[q])) continue;
    const auto row = static_cast<std::size_t>(rows[q]);
    const double* v = grains.velocity_of(row);
    double* action = grains.fluid_action + 4 * row;
    for (std::size_t d = 0; d < 3; ++d) action[d] = v[d] + seen.slip[d][q];
    action[3] = coefficient(grains, row, batch.factor[q]) * v[3];
  }
}

/// The change of each grain's velocity until half way, and the batch's Reynolds numbers then.
void Coupling::Impl::look_ahead(const particles::GrainRows& grains, Rows rows, double held,
                                const Seen& seen, Batch& batch, Foresight& ahead) {
  begin_action(grains, rows, seen, batch);
  const double half = 0.5 * held;
  const double before = last_held > 0.0 ? half / last_held : 0.0;
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    const double* v = grains.velocity_of(row);
    const double* action = grains.fluid_action + 4 * row;
    Remembered& r = memory[row];
    const bool is_known = r.has_velocity && before > 0.0;
    ahead.rate[q] = action[3];
    ahead.is_known[q] = is_known ? 1.0 : 0.0;
    // Of a new grain only the drag is known; its weight may be borne by what else acts on it.
    const double volume = sdk::sphere_volume(2.0 * grains.position[4 * row + 3]);
    ahead.weight[q] = is_known ? weight_share(v[3], volume) : 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      ahead.pull[d][q] = action[d] - v[d];
      ahead.change[d][q] = v[d] - r.velocity[d];
      r.velocity[d] = v[d];
      r.fluid_velocity[d] = v[d] + seen.slip[d][q];
    }
    r.has_velocity = true;
    batch.size_ratio[q] = r.size_ratio;
  }
  foresee(rows.size(), half, before, {gravity.x, gravity.y, gravity.z}, seen.slip, ahead);
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    batch.reynolds[q] = reynolds(grains, row, batch.void_fraction[q], ahead.speed[q]);
  }
}

/// Void fraction and stress of the cells that the grains of a batch are in; returns whether some of
/// them are larger than a cell.
bool Coupling::Impl::look_into_cells(const SpotBatch& spot, Rows rows, const FluidState& state,
                                     Seen& seen, Batch& batch) {
  const bool needs_stress = !is_set_three || forces;
  WideKernel wide(lattice, voidage);
  bool has_wide = false;
  // Grains of one cell come one after another.
  std::ptrdiff_t last_cell = -1;
  double eps = 1.0;
  Triple stress{};
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const double* position = &spot.position[4 * q];
    const std::ptrdiff_t cell = spot.cell(q);
    const bool is_wide = wide.takes(position[3]);
    has_wide = has_wide || is_wide;
    if (cell != last_cell || is_wide) {
      last_cell = is_wide ? -1 : cell;
      eps = void_fraction_at(position, cell, wide);
      for (int d = 0; needs_stress && d < 3; ++d) {
        stress[d] = lattice.face_mean(d, cell, cell + spot.face_step[d][q],
                                      state.stress_divergence.component[d]);
      }
    }
    batch.void_fraction[q] = eps;
    for (std::size_t d = 0; d < 3; ++d) seen.stress[d][q] = stress[d];
  }
  return has_wide;
}

/// Component d of what the grains larger than a cell see.
void Coupling::Impl::look_wide(const SpotBatch& spot, int d, const FluidState& state,
                               const double* v, const FaceSumColumns& sums, double* flux,
                               double* stress) const {
  const std::vector<double>& u = state.velocity.component[d];
  const std::vector<double>& push = state.stress_divergence.component[d];
  const bool needs_stress = !is_set_three || forces;
  WideKernel wide(lattice, voidage);
  WideStencil many;
  for (std::size_t q = 0; q < spot.count; ++q) {
    const double* position = &spot.position[4 * q];
    if (!wide.takes(position[3])) continue;
    wide.set(position, position[3]);
    wide.stencil(d, void_fraction.after(), many);
    sums.open[q] = sums.fluid[q] = flux[q] = stress[q] = 0.0;
    for (std::size_t n = 0; n < many.size(); ++n) {
      flux[q] += many.weight[n] * many.void_fraction[n] * (u[many.home[n]] - v[q]);
      const double part = many.weight[n] * many.open[n];
      sums.open[q] += part;
      sums.fluid[q] += part * many.void_fraction[n];
      if (needs_stress && many.open[n] > 0.0) stress[q] += many.weight[n] * push[many.home[n]];
    }
  }
}

void Coupling::Impl::refresh(const particles::GrainRows& grains, std::size_t number, Rows rows,
                             const FluidState& state) {
  Batch batch;
  Seen seen;
  look(grains, spots.batches[number], rows, state, seen, batch);
  Foresight ahead;
  look_ahead(grains, rows, held(state), seen, batch, ahead);
  evaluate(batch, rows.size());
  // The ratio differs from 1 only where the void fraction changes. It is applied to the slip half
  // way, because the grain has one rate for all directions.
  const auto relative_slip = [&](std::size_t d, std::size_t q) {
    const double change = ahead.change[d][q];
    return seen.ratio[d][q] * (seen.slip[d][q] - change) + change;
  };
  if (forces) {
    ForceTerms::Sums sums;
    const auto columns = [](const std::array<SpotBatch::Reals, 3>& v) {
      return sdk::VectorColumns{v[0].data(), v[1].data(), v[2].data()};
    };
    const ForceTerms::Batch terms{rows, batch.void_fraction.data(), columns(seen.slip),
                                  columns(seen.stress)};
    forces->evaluate(grains, terms, state, held(state), memory, sums);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const auto row = static_cast<std::size_t>(rows[n]);
      const double drag_coefficient = coefficient(grains, row, batch.factor[n]) *
                                      share_of_set(batch.void_fraction[n]) / stress_part(row);
      Triple relative;
      for (std::size_t d = 0; d < 3; ++d) relative[d] = relative_slip(d, n);
      act(grains, row, n, drag_coefficient, relative, held(state), sums);
    }
    return;
  }
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    const double diameter = 2.0 * grains.position[4 * row + 3];
    const double* v = grains.velocity_of(row);
    double* action = grains.fluid_action + 4 * row;
    Remembered& r = memory[row];
    const Fluid fluid = fluid_at(grains.position + 4 * row);
    const double drag_coefficient = coefficient(grains, row, batch.factor[q]) *
                                    share_of_set(batch.void_fraction[q]) / stress_part(row);
    const double per_drag = 1.0 / drag_coefficient;
    const double volume = sdk::sphere_volume(diameter);
    // The grains' reduced gravity is that of the fluid's own density.
    const double lift = volume * (properties.own().density - fluid.density);
    for (std::size_t d = 0; d < 3; ++d) {
      const double force =
          volume * seen.stress[d][q] + (lift == 0.0 ? 0.0 : lift * gravity[static_cast<int>(d)]);
      action[d] = v[d] + relative_slip(d, q) + force * per_drag;
      r.stress_impulse[d] += force;
    }
    action[3] = drag_coefficient * v[3];
  }
}

/// The action on a grain with forces besides drag. The grain obeys
///   (m + m_a) dv/dt = K (relative slip) + sum of forces + m g' + contacts ,
/// while the DEM integrates dv/dt = rate (target - v) + g' + contacts / m: the target makes up for
/// the difference, for the contacts with those of the last interval.
void Coupling::Impl::act(const particles::GrainRows& grains, std::size_t row, std::size_t n,
                         double drag_coefficient, const Triple& relative, double held,
                         const ForceTerms::Sums& sums) {
  const double* v = grains.velocity_of(row);
  double* action = grains.fluid_action + 4 * row;
  Remembered& r = memory[row];
  const double mass = 1.0 / v[3];
  const double moved = mass + sums.added_mass[n];
  const double volume = sdk::sphere_volume(2.0 * grains.position[4 * row + 3]);
  const double share = forces->weight_share(mass, volume);
  const bool is_buoyancy_taken = forces->taken().buoyancy;
  const double lift =
      is_buoyancy_taken
          ? 0.0
          : volume * (properties.own().density - fluid_at(grains.position + 4 * row).density);
  Triple pull;       // [N] all but m g' and contacts
  Triple contained;  // [N] of it, what the fluid does not receive
  for (std::size_t d = 0; d < 3; ++d) {
    const double g = gravity[static_cast<int>(d)];
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
      change += towards * (pull[d] / moved + share * gravity[static_cast<int>(d)]) * held;
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

void Coupling::Impl::collect(const particles::GrainRows& grains, double fluid_step) {
  if (done_refreshes == 0) {
    throw std::logic_error("Coupling::collect() without a refresh() since map()");
  }
  if (is_overlapped && !is_settled) {
    throw std::logic_error("Coupling::collect() without settle(), where grains and fluid overlap");
  }
  memory.align(grains);
  const double interval = fluid_step / static_cast<double>(done_refreshes);
  if (stress_book) stress_received.resize(grains.count);
  const tbb::blocked_range<std::size_t> all(0, grains.count, 4 * k_batch);
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t row = range.begin(); row < range.end(); ++row) {
      double* received = grains.fluid_impulse + 4 * row;
      Remembered& r = memory[row];
      if (forces) forces->impulse_was_read(memory, row, received);
      for (std::size_t d = 0; stress_book && d < 3; ++d) {
        stress_received[row][d] = grains.weight[row] * interval * r.stress_impulse[d];
      }
      for (int d = 0; d < 3; ++d) {
        const double drag_impulse = received[d] - interval * r.stress_impulse[d];
        if (!is_one_way && r.is_paired[d]) {
          r.owed[d] += r.given[d] - grains.weight[row] * drag_impulse;
        }
        r.place[d] = grains.position[4 * row + d];
        r.stress_impulse[d] = 0.0;
        received[d] = 0.0;
      }
    }
  });
  if (stress_book) stress_book->receive(spots, stress_received);
}

}  // namespace dust::coupling

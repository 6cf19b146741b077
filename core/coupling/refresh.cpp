// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling_impl.hpp"
#include "dust/sdk/sphere.hpp"

#include <stdexcept>

namespace dust::coupling {

/// What the grains see of the fluid: slip, what the drag on the grain is of the law's, stress; the
/// batch's Reynolds numbers and void fractions.
void Coupling::Impl::look(const particles::GrainRows& grains, std::size_t first, std::size_t last,
                          const FluidState& state, Seen& seen, Batch& batch) {
  const std::size_t count = last - first;
  const fluid::CellField& eps = void_fraction.after();
  static thread_local SpotBatch spot;
  SpotBatch::Reals own;
  SpotBatch::Reals v;
  SpotBatch::Reals open;
  SpotBatch::Reals fluid;
  SpotBatch::Reals flux;  // relative to the grain: it does not jump with eps in plug flow
  WideKernel wide(lattice, voidage);
  WideStencil many;
  lattice.place(grains.position + 4 * first, count, spot);
  for (std::size_t q = 0; q < count; ++q) {
    const double* position = grains.position + 4 * (first + q);
    own[q] = void_fraction_at(position, spot.cell(q), wide);
    if (is_own_taken_off) own[q] = std::min(1.0, own[q] + memory.own_flow(first + q).solids);
  }
  for (int d = 0; d < 3; ++d) {
    const double* u = state.velocity.component[d].data();
    const std::vector<double>& push = state.stress_divergence.component[d];
    for (std::size_t q = 0; q < count; ++q) v[q] = grains.velocity[4 * (first + q) + d];
    look_at_faces(spot, d, count, face_void.columns(d), u, v.data(), {open.data(), fluid.data()},
                  flux.data());
    for (std::size_t q = 0; q < count; ++q) {
      Remembered& r = memory[first + q];
      const double* position = grains.position + 4 * (first + q);
      double pushed = 0.0;
      if (wide.takes(position[3])) {
        open[q] = fluid[q] = flux[q] = 0.0;
        wide.set(position, position[3]);
        wide.stencil(d, eps, many);
        for (std::size_t n = 0; n < many.size(); ++n) {
          flux[q] += many.weight[n] * many.void_fraction[n] * (u[many.home[n]] - v[q]);
          const double part = many.weight[n] * many.open[n];
          open[q] += part;
          fluid[q] += part * many.void_fraction[n];
          if (many.open[n] > 0.0) pushed += many.weight[n] * push[many.home[n]];
        }
      } else if (!is_set_three || forces) {
        const std::ptrdiff_t low = spot.cell(q);
        pushed = lattice.face_mean(d, low, low + spot.face_step[d][q], push);
      }
      double slip = flux[q] / own[q];
      double around = open[q] > 0.0 ? fluid[q] / open[q] : own[q];
      if (is_own_taken_off) {
        const OwnFlow& flow = memory.own_flow(first + q);
        slip += flow.disturbance[d];
        if (open[q] > 0.0) around += flow.face_solids[d];
      }
      seen.slip[q][d] = slip;
      seen.ratio[q][d] = is_set_three ? 1.0 : around / own[q];
      r.fluid_velocity[d] = v[q] + slip;
      seen.stress[q][d] = is_set_three && !forces ? 0.0 : pushed;
    }
  }
  for (std::size_t q = 0; q < count; ++q) {
    const double* position = grains.position + 4 * (first + q);
    Remembered& r = memory[first + q];
    r.has_velocity = true;
    batch.void_fraction[q] = own[q];
    const Triple& w = seen.slip[q];
    const double speed = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    batch.reynolds[q] = reynolds(fluid_at(position), own[q], speed, 2.0 * position[3]);
    batch.size_ratio[q] = r.size_ratio;
  }
}

void Coupling::Impl::refresh(const particles::GrainRows& grains, std::size_t first,
                             std::size_t last, const FluidState& state) {
  Batch batch;
  Seen seen;
  look(grains, first, last, state, seen, batch);
  evaluate(batch, last - first);
  if (forces) {
    ForceTerms::Sums sums;
    const ForceTerms::Batch terms{first, last - first, batch.void_fraction.data(), seen.slip.data(),
                                  seen.stress.data()};
    forces->evaluate(grains, terms, state, held(state), memory, sums);
    for (std::size_t row = first; row < last; ++row) {
      const std::size_t n = row - first;
      const double drag_coefficient =
          coefficient(fluid_at(grains.position + 4 * row), 2.0 * grains.position[4 * row + 3],
                      batch.factor[n]) *
          share_of_set(batch.void_fraction[n]) / stress_part(row);
      Triple relative;
      for (std::size_t d = 0; d < 3; ++d) relative[d] = seen.ratio[n][d] * seen.slip[n][d];
      act(grains, row, n, drag_coefficient, relative, held(state), sums);
    }
    return;
  }
  for (std::size_t row = first; row < last; ++row) {
    const double diameter = 2.0 * grains.position[4 * row + 3];
    const double* v = grains.velocity + 4 * row;
    double* action = grains.fluid_action + 4 * row;
    Remembered& r = memory[row];
    const Fluid fluid = fluid_at(grains.position + 4 * row);
    const double drag_coefficient = coefficient(fluid, diameter, batch.factor[row - first]) *
                                    share_of_set(batch.void_fraction[row - first]) /
                                    stress_part(row);
    const double volume = sdk::sphere_volume(diameter);
    // The grains' reduced gravity is that of the fluid's own density.
    const double lift = volume * (properties.own().density - fluid.density);
    for (int d = 0; d < 3; ++d) {
      // The ratio differs from 1 only where the void fraction changes; it is applied to the slip of
      // this instant, because the grain has one rate for all directions.
      const double relative = seen.ratio[row - first][d] * seen.slip[row - first][d];
      const double force =
          volume * seen.stress[row - first][d] + (lift == 0.0 ? 0.0 : lift * gravity[d]);
      action[d] = v[d] + relative + force / drag_coefficient;
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
  const double* v = grains.velocity + 4 * row;
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
  memory.align(grains);
  const double interval = fluid_step / static_cast<double>(done_refreshes);
  for_batches(grains.count, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      double* received = grains.fluid_impulse + 4 * row;
      Remembered& r = memory[row];
      if (forces) forces->impulse_was_read(memory, row, received);
      for (int d = 0; d < 3; ++d) {
        const double drag_impulse = received[d] - interval * r.stress_impulse[d];
        if (!is_one_way && r.is_paired[d]) {
          r.owed[d] += grains.weight[row] * (r.given[d] - drag_impulse);
        }
        if (is_own_taken_off) {
          // Per real grain; the mobility counts the weight.
          OwnFlow& own = memory.own_flow(row);
          const double steady = own.mobility * drag_impulse / fluid_step;
          own.disturbance[d] += own.growth * (steady - own.disturbance[d]);
        }
        r.place[d] = grains.position[4 * row + d];
        received[d] = 0.0;
      }
    }
  });
}

}  // namespace dust::coupling

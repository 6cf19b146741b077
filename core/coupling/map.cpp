// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling_impl.hpp"

#include "dust/sdk/error.hpp"

namespace dust::coupling {
namespace {

/// Least part of the true drag coefficient given to the fluid. The mean drag of a free grain falls
/// short of it when the grain follows the fluid within the step; a grain held by its neighbours
/// feels it in full, and what the fluid was not given comes one step late. That is stable only if
/// the late part is the smaller one: the share must exceed 1/2.
constexpr double k_least_implicit = 0.6;

}  // namespace

/// Place, velocity and the implicit drag coefficient of each grain. The slip is that with the fluid
/// last seen at the grain (the initial velocity for a new one); collect() makes up for the lag.
void Coupling::Impl::remember(const particles::GrainRows& grains, std::size_t first,
                              std::size_t last) {
  Batch batch;
  WideKernel wide(lattice, voidage);
  SpotBatch& here = spots.batches[first / k_batch];
  lattice.place(grains.position + 4 * first, last - first, here);
  if (is_own_taken_off) find_own_solids(grains, first, last);
  for (std::size_t row = first; row < last; ++row) {
    const double* position = grains.position + 4 * row;
    const double* velocity = grains.velocity + 4 * row;
    Remembered& r = memory[row];
    r.place = {position[0], position[1], position[2]};
    r.velocity = {velocity[0], velocity[1], velocity[2]};
    if (!r.has_velocity) r.fluid_velocity = initial_velocity;
    double slip = 0.0;
    for (int d = 0; d < 3; ++d) {
      slip += (r.fluid_velocity[d] - velocity[d]) * (r.fluid_velocity[d] - velocity[d]);
    }
    slip = std::sqrt(slip);
    spots.eps[row] = void_fraction_at(position, here.cell(row - first), wide);
    double eps = spots.eps[row];
    if (is_own_taken_off) {
      eps += memory.own_flow(row).solids;
      find_own_flow(grains, row, eps, slip);
    }
    batch.void_fraction[row - first] = eps;
    batch.reynolds[row - first] = reynolds(fluid_at(position), eps, slip, 2.0 * position[3]);
    batch.size_ratio[row - first] = r.size_ratio;
  }
  evaluate(batch, last - first);
  for (std::size_t row = first; row < last; ++row) {
    const double diameter = 2.0 * grains.position[4 * row + 3];
    const double inverse_mass = grains.velocity[4 * row + 3];
    const Fluid fluid = fluid_at(grains.position + 4 * row);
    const double drag_coefficient = coefficient(fluid, diameter, batch.factor[row - first]) *
                                    share_of_set(batch.void_fraction[row - first]) /
                                    stress_part(row);
    // A free grain relaxes within the step: mean drag = (m / step) (1 - exp(-K step / m)) (u - v).
    const double relaxations = drag_coefficient * inverse_mass * step;
    const double mean = -std::expm1(-relaxations) / relaxations;
    // The faces' coefficients hold the set's share already.
    memory[row].coefficient = drag_coefficient * std::max(mean, k_least_implicit) /
                              share_of_set(batch.void_fraction[row - first]);
    memory[row].stress_impulse = {};
    memory[row].given = {};
  }
}

void Coupling::Impl::map(const particles::GrainRows& grains, double fluid_step) {
  step = fluid_step;
  memory.align(grains);
  double fastest = 0.0;  // 3 pi mu D / m [1/s]
  for (std::size_t row = 0; row < grains.count; ++row) {
    const double* position = grains.position + 4 * row;
    fastest = std::max(fastest, coefficient(fluid_at(position), 2.0 * position[3], 1.0) *
                                    grains.velocity[4 * row + 3]);
  }
  refreshes = refreshes_for(step, fastest);
  done_refreshes = 0;
  if (needs_size_ratio) find_size_ratios(grains);
  if (is_one_way) return;

  const VoidFraction::Counts counts = void_fraction.map(grains);
  const double limit = voidage.largest_diameter_over_spacing();
  if (counts.largest_ratio > limit * (1.0 + k_ratio_rounding)) {
    const std::size_t row = counts.largest_row;
    throw sdk::ModelError(text("grain ", grains.id[row], " of diameter ",
                               2.0 * grains.position[4 * row + 3], " m is too large for cells of ",
                               least_spacing, " m: the voidage rule is valid for D/dx up to ",
                               limit, "; use fewer cells"));
  }
  report.moved_shares += counts.moved_shares;
  report.relieved_cells += counts.relieved_cells;
  report.unplaced_grains += counts.unplaced_grains;
  report.smallest_void_fraction = std::min(report.smallest_void_fraction, counts.smallest);
  report.largest_diameter_over_spacing =
      std::max(report.largest_diameter_over_spacing, counts.largest_ratio);
  if (counts.smallest <= 0.0) {
    throw sdk::ModelError(
        text("the grains in one cell fill ", 1.0 - counts.smallest,
             " of its open volume and no cell around has room; use fewer cells, or look for grains "
             "that overlap or lie inside bodies"));
  }
  face_void.update(void_fraction.after(), void_fraction.filled_cells());
  spots.batches.resize((grains.count + k_batch - 1) / k_batch);
  spots.eps.resize(grains.count);
  spots_order = memory.order();
  for_batches(grains.count,
              [&](std::size_t first, std::size_t last) { remember(grains, first, last); });
  report.unpaired_forces += faces.spread(grains, spots, memory, void_fraction.after(), step);
  is_settled = false;
}

/// Diameter of each grain over the Sauter mean of those in its cell, summed in row order.
void Coupling::Impl::find_size_ratios(const particles::GrainRows& grains) {
  size_sums.assign(lattice.grid().size, {0.0, 0.0});
  const auto cell_of = [&](std::size_t row) {
    const double* position = grains.position + 4 * row;
    return static_cast<std::size_t>(
        lattice.host_cell(lattice.cell(lattice.place(position)), position));
  };
  for (std::size_t row = 0; row < grains.count; ++row) {
    const double diameter = 2.0 * grains.position[4 * row + 3];
    std::array<double, 2>& sums = size_sums[cell_of(row)];
    sums[0] += grains.weight[row] * diameter * diameter * diameter;
    sums[1] += grains.weight[row] * diameter * diameter;
  }
  for (std::size_t row = 0; row < grains.count; ++row) {
    const std::array<double, 2>& sums = size_sums[cell_of(row)];
    memory[row].size_ratio = 2.0 * grains.position[4 * row + 3] * sums[1] / sums[0];
  }
}

void Coupling::Impl::settle(const particles::GrainRows& grains, const fluid::FaceField& velocity) {
  if (spots_order != memory.order()) {
    // The rows are in another order than at map().
    spots.batches.resize((grains.count + k_batch - 1) / k_batch);
    for_batches(grains.count, [&](std::size_t first, std::size_t last) {
      std::array<double, 4 * k_batch> places;
      for (std::size_t row = first; row < last; ++row) {
        std::copy_n(memory[row].place.data(), 3, &places[4 * (row - first)]);
      }
      lattice.place(places.data(), last - first, spots.batches[first / k_batch]);
    });
    spots_order = memory.order();
  }
  const double imbalance =
      faces.settle(grains, spots.batches, memory, void_fraction.after(), velocity, step);
  report.largest_imbalance = std::max(report.largest_imbalance, imbalance);
  is_settled = true;
}

}  // namespace dust::coupling

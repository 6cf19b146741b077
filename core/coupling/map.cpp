// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling_impl.hpp"

#include "dust/sdk/error.hpp"

#include <stdexcept>

namespace dust::coupling {
namespace {

/// Least part of the true drag coefficient given to the fluid. The mean drag of a free grain falls
/// short of it when the grain follows the fluid within the step; a grain held by its neighbours
/// feels it in full, and what the fluid was not given comes one step late. That is stable only if
/// the late part is the smaller one: the share must exceed 1/2, and 2/3 where the fluid takes many
/// sub-steps.
constexpr double k_least_implicit = 0.7;

/// The same where the grains' cycle overlaps the fluid's step. What grains receive is then that of
/// the step before: errors of a held one follow h x^2 - h x + 1 = 0, |x|^2 = 1/h, so that the
/// fluid must be given more than the true coefficient (the rest of the debt is taken back). Free
/// grains are stable from 1 to 4.
constexpr double k_overlapped_implicit = 2.0;

/// Relative change of the Reynolds number by which the steepness of a drag law is found.
constexpr double k_reynolds_change = 0.01;

}  // namespace

bool Coupling::Impl::locate(const particles::GrainRows& grains, Rows rows, SpotBatch& batch,
                            double ahead) const {
  bool is_other = batch.count != rows.size();
  double* known = batch.position.data();
  const std::array<double, 4> times{ahead, ahead, ahead, 0.0};
  for (const std::int32_t row : rows) {
    const double* position = grains.position + 4 * static_cast<std::size_t>(row);
    const double* velocity = grains.velocity_of(static_cast<std::size_t>(row));
    for (std::size_t n = 0; n < 4; ++n) {
      const double place = position[n] + times[n] * velocity[n];
      is_other |= known[n] != place;
      known[n] = place;
    }
    known += 4;
  }
  // Grains that lie still are where they were.
  if (!is_other) return false;
  batch.count = rows.size();
  lattice.place(batch);
  return true;
}

/// The slip of each grain with the fluid last seen at it (the initial velocity for a new one).
void Coupling::Impl::find_slips(const particles::GrainRows& grains, std::size_t batch, Rows rows,
                                Batch& columns) {
  WideKernel wide(lattice, voidage);
  SpotBatch& here = spots.batches[batch];
  double* around = spots.eps.data() + batch * k_batch;
  locate(grains, rows, here);
  char* is_smooth = spots.is_smooth.data() + batch * k_batch;
  SmoothKernel smooth(lattice);
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    const double* position = grains.position + 4 * row;
    const double* velocity = grains.velocity_of(row);
    Remembered& r = memory[row];
    r.spot = static_cast<std::int32_t>(batch * k_batch + q);
    if (!r.has_velocity) r.fluid_velocity = initial_velocity;
    double slip = 0.0;
    for (int d = 0; d < 3; ++d) {
      slip += (r.fluid_velocity[d] - velocity[d]) * (r.fluid_velocity[d] - velocity[d]);
    }
    slip = std::sqrt(slip);
    around[q] = void_fraction_at(position, here.cell(q), wide);
    is_smooth[q] = 0;
    if (memory.has_own_flow()) {
      is_smooth[q] = take_own_off(grains, row, slip, smooth, around[q]) ? 1 : 0;
    }
    columns.void_fraction[q] = around[q];
    columns.reynolds[q] = reynolds(grains, row, around[q], slip);
    columns.size_ratio[q] = r.size_ratio;
  }
}

/// How drag grows with the slip at the present factors, d ln F / d ln Re: 0 for a viscous drag, 1
/// for one of inertia. Spoils the factors and Reynolds numbers.
void Coupling::Impl::find_steepness(Batch& columns, std::size_t count, double* steepness) const {
  SpotBatch::Reals factor;
  for (std::size_t q = 0; q < count; ++q) {
    factor[q] = columns.factor[q];
    columns.reynolds[q] *= 1.0 + k_reynolds_change;
  }
  evaluate(columns, count);
  for (std::size_t q = 0; q < count; ++q) {
    const double growth = columns.factor[q] / factor[q] - 1.0;
    steepness[q] = std::clamp(growth * (1.0 / k_reynolds_change), 0.0, 1.0);
  }
}

/// The drag of each grain as the fluid is given it. The slip is that of before; collect() makes up
/// for the lag.
void Coupling::Impl::remember(const particles::GrainRows& grains, std::size_t batch, Rows rows,
                              double* coefficient_of_fluid, double* steepness) {
  Batch columns;
  find_slips(grains, batch, rows, columns);
  evaluate(columns, rows.size());
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    const double inverse_mass = grains.velocity_of(row)[3];
    // The faces' coefficients hold the set's share already.
    const double of_faces = coefficient(grains, row, columns.factor[q]) / stress_part(row);
    const double drag_coefficient = of_faces * share_of_set(columns.void_fraction[q]);
    // A free grain relaxes within the step: mean drag = (m / step) (1 - exp(-K step / m)) (u - v).
    const double relaxations = drag_coefficient * inverse_mass * step;
    const double mean = -std::expm1(-relaxations) / relaxations;
    const double part = is_overlapped ? k_overlapped_implicit : std::max(mean, k_least_implicit);
    coefficient_of_fluid[q] = of_faces * part;
  }
  find_steepness(columns, rows.size(), steepness);
  // There is no tangent where no fluid has been seen yet.
  for (std::size_t q = 0; q < rows.size(); ++q) {
    if (!memory[static_cast<std::size_t>(rows[q])].has_velocity) steepness[q] = 0.0;
  }
}

void Coupling::Impl::sort(const particles::GrainRows& grains) {
  spots.order.sort(lattice.grid(), grains.position, grains.count);
  spots.memory_order = memory.order();
  are_spots_of_map = false;
  spots.batches.resize((grains.count + k_batch - 1) / k_batch);
  spots.eps.resize(grains.count);
  spots.is_smooth.resize(grains.count);
}

void Coupling::Impl::sort_if_changed(const particles::GrainRows& grains) {
  if (spots.memory_order == memory.order() && spots.order.rows().size() == grains.count) return;
  sort(grains);
}

/// The void fraction of cells and faces round the grains where they are. Asks no drag law.
void Coupling::Impl::map_solids(const particles::GrainRows& grains) {
  const bool may_be_alone = own_flow_is != scenario::OwnDisturbance::felt;
  if (may_be_alone && !memory.has_own_flow() && has_candidates(grains)) memory.keep_own_flow();
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
  if (memory.has_own_flow()) spread_smoothly(grains);
  face_void.update(void_fraction.after(), void_fraction.filled_cells());
}

void Coupling::Impl::start(const particles::GrainRows& grains) {
  memory.align(grains);
  sort(grains);
  if (!is_one_way) map_solids(grains);
}

void Coupling::Impl::map(const particles::GrainRows& grains, double fluid_step) {
  step = fluid_step;
  memory.align(grains);
  double fastest = 0.0;  // 3 pi mu D / m [1/s]
  for (std::size_t row = 0; row < grains.count; ++row) {
    fastest = std::max(fastest, coefficient(grains, row, 1.0) * grains.velocity_of(row)[3]);
  }
  refreshes = refreshes_for(step, fastest);
  done_refreshes = 0;
  if (needs_size_ratio) find_size_ratios(grains);
  sort(grains);
  if (is_one_way) return;
  map_solids(grains);
  const fluid::CellField& eps = void_fraction.after();
  faces.resize(spots.batches.size());
  for_batches([&](std::size_t batch, Rows rows) {
    SpotBatch::Reals coefficient;
    SpotBatch::Reals steepness;
    remember(grains, batch, rows, coefficient.data(), steepness.data());
    faces.charge(grains, spots, batch, {coefficient.data(), steepness.data()}, memory, eps, step);
  });
  are_spots_of_map = true;
  if (is_overlapped) mapped_spots = spots;
  report.unpaired_forces += faces.spread(spots, memory, eps, step, stress_book.get());
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
    sums[1] += grains.weight[row] * diameter * diameter * graining.of(grains, row);
  }
  for (std::size_t row = 0; row < grains.count; ++row) {
    const std::array<double, 2>& sums = size_sums[cell_of(row)];
    memory[row].size_ratio =
        2.0 * grains.position[4 * row + 3] / graining.of(grains, row) * sums[1] / sums[0];
  }
}

void Coupling::Impl::settle(const fluid::FaceField& velocity) {
  is_settled = true;
  if (is_one_way) return;
  if (!is_overlapped && !are_spots_of_map) {
    throw std::logic_error("Coupling::settle() after a refresh() of grains that have moved");
  }
  const Spots& mapped = is_overlapped ? mapped_spots : spots;
  std::span<const std::int32_t> rows = mapped.order.rows();
  std::vector<std::int32_t> rows_now;
  if (mapped.memory_order != memory.order()) {
    rows_now.assign(rows.size(), -1);
    for (std::size_t row = 0; row < memory.size(); ++row) {
      const std::int32_t spot = memory[row].spot;
      if (spot >= 0) rows_now[static_cast<std::size_t>(spot)] = static_cast<std::int32_t>(row);
    }
    rows = rows_now;
  }
  const double imbalance =
      faces.settle(mapped, rows, memory, void_fraction.after(), velocity, step);
  report.largest_imbalance = std::max(report.largest_imbalance, imbalance);
  advance_own_flow();
}

}  // namespace dust::coupling

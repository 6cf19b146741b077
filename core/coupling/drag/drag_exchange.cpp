// SPDX-License-Identifier: Apache-2.0
#include "coupling/drag/drag_exchange.hpp"

#include "coupling/stress_balance.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dust::coupling {
namespace {

/// Weight of open faces below which a force component finds no fluid to act on.
constexpr double k_min_weight = 1e-6;

/// Part of a cell's residual that the fluid receives in one step. The pressure answers it, and with
/// that the next residual: all at once would rock a bed in which the fluid is the smaller part.
constexpr double k_released_share = 0.5;
/// [N s] A residual smaller than this is dropped.
constexpr double k_nothing_deferred = 1e-60;

/// Sums over the eight faces of a grain.
struct FaceSums {
  double open = 0.0;   ///< a = sum(w open)
  double fluid = 0.0;  ///< e = sum(w open eps)
};

template <class Faces>
FaceSums sums_of(const Faces& s) {
  FaceSums sums;
  for (std::size_t n = 0; n < size(s); ++n) {
    const double part = s.weight[n] * s.open[n];
    sums.open += part;
    sums.fluid += part * s.void_fraction[n];
  }
  return sums;
}

}  // namespace

DragExchange::DragExchange(const Lattice& lattice, const FaceVoidFraction& face_void,
                           const sdk::VoidageRule& rule, fluid::MomentumSet set)
    : lattice_(lattice),
      face_void_(face_void),
      rule_(rule),
      set_(set),
      exchange_{fluid::FaceField(lattice.grid()), fluid::FaceField(lattice.grid())} {}

void DragExchange::clear(int d) {
  for (const ActiveFace& t : active_[d]) {
    exchange_.coefficient.component[d][t.face] = 0.0;
    exchange_.source.component[d][t.face] = 0.0;
  }
  active_[d].clear();
}

void DragExchange::resize(std::size_t batches) { batches_.resize(batches); }

void DragExchange::assemble(const ParticleBatch& particles, std::size_t number,
                            const LinearisedDrag& drag, ParticleStates& states,
                            const fluid::CellField& eps, double step) {
  const StencilBatch& here = particles.here;
  BatchContributions& batch = batches_[number];
  BatchInputs inputs;
  begin_batch(particles, drag, states, step, inputs, batch);
  for (int d = 0; d < 3; ++d) {
    ContributionInputs& input = inputs.component[d];
    input.coefficient = inputs.coefficient.data();
    sum_faces(here, d, face_void_.columns(d), {input.open.data(), input.fluid.data()});
    if (batch.has_multi_cell) sum_multi_cell(here, d, eps, input);
  }
  if (batch.has_smooth) assemble_smooth(particles, drag, states, inputs.component, batch);
  const bool is_density = set_ == fluid::MomentumSet::three;
  for (int d = 0; d < 3; ++d) {
    find_contributions(particles.size(), inputs.component[d], k_min_weight, is_density,
                       batch.component[d]);
  }
  release(particles.rows, inputs.component, states, batch);
}

/// The drag of each particle per cell volume, what its slip before takes back, and its residual.
void DragExchange::begin_batch(const ParticleBatch& particles, const LinearisedDrag& drag,
                               const ParticleStates& states, double step, BatchInputs& inputs,
                               BatchContributions& batch) const {
  const particles::GrainRows& grains = particles.grains;
  const double per_volume = 1.0 / lattice_.cell_volume();
  const double per_volume_and_step = per_volume / step;
  const MultiCellKernel multi_cell(lattice_, rule_);
  batch.is_smooth = drag.is_smooth;
  batch.unpaired = 0;
  batch.has_multi_cell = batch.has_smooth = false;
  batch.released = batch.given = batch.size = {};
  for (std::size_t q = 0; q < particles.size(); ++q) {
    const std::size_t row = particles.row(q);
    const double isolated = drag.void_fraction[q];
    const double slope = 1.0 + drag.slope[q];
    inputs.coefficient[q] =
        grains.weight[row] * drag.coefficient[q] * slope * per_volume / (isolated * isolated);
    const double back = isolated * drag.slope[q] / slope;
    const bool is_smooth = drag.is_smooth[q] != 0;
    batch.has_smooth = batch.has_smooth || is_smooth;
    batch.has_multi_cell =
        batch.has_multi_cell || (!is_smooth && multi_cell.takes(particles.here.radius(q)));
    for (std::size_t d = 0; d < 3; ++d) {
      const double v = grains.velocity_of(row)[d];
      batch.component[d].velocity[q] = v;
      batch.component[d].flux_difference[q] = back * (v - states[row].fluid_velocity[d]);
      inputs.component[d].deferred[q] = states[row].deferred[d] * per_volume_and_step;
      inputs.component[d].gain[q] = 1.0;
    }
  }
}

/// The residuals that find open faces are in the source now.
void DragExchange::release(std::span<const std::int32_t> rows,
                           const std::array<ContributionInputs, 3>& inputs, ParticleStates& states,
                           BatchContributions& batch) const {
  for (std::size_t q = 0; q < rows.size(); ++q) {
    ParticleState& r = states[static_cast<std::size_t>(rows[q])];
    for (std::size_t d = 0; d < 3; ++d) {
      r.is_paired[d] = inputs[d].open[q] > k_min_weight;
      batch.unpaired += r.is_paired[d] ? 0 : 1;
      if (!r.is_paired[d]) continue;
      batch.released[d] += r.deferred[d];
      r.deferred[d] = 0.0;
    }
  }
}

/// The sums over the faces of the grains that are larger than a cell.
void DragExchange::sum_multi_cell(const StencilBatch& stencils, int d, const fluid::CellField& eps,
                                  ContributionInputs& input) const {
  MultiCellKernel multi_cell(lattice_, rule_);
  MultiCellStencil many;
  for (std::size_t q = 0; q < stencils.count; ++q) {
    if (!multi_cell.takes(stencils.radius(q))) continue;
    multi_cell.set(stencils.position_of(q), stencils.radius(q));
    multi_cell.stencil(d, eps, many);
    const FaceSums faces = sums_of(many);
    input.open[q] = faces.open;
    input.fluid[q] = faces.fluid;
  }
}

/// What changes for the grains with a SmoothKernel: the void fraction that makes a slip of the flux
/// is that of SelfFlow, their own flow is no part of the slip, and the drag is spread such that its
/// sum is K times that slip; docs/theory/own_disturbance.md, eq. (7).
void DragExchange::assemble_smooth(const ParticleBatch& particles, const LinearisedDrag& drag,
                                   const ParticleStates& states,
                                   std::array<ContributionInputs, 3>& inputs,
                                   BatchContributions& batch) const {
  const StencilBatch& here = particles.here;
  SmoothKernel kernel(lattice_);
  for (std::size_t q = 0; q < particles.size(); ++q) {
    if (drag.is_smooth[q] == 0) continue;
    const SelfFlow& own = states.self_flow(particles.row(q));
    kernel.set(here.position_of(q), 2.0 * here.radius(q));
    const double isolated = drag.void_fraction[q];
    for (int d = 0; d < 3; ++d) {
      const auto c = static_cast<std::size_t>(d);
      const FaceColumns columns = face_void_.columns(d);
      const auto [open, fluid] = kernel.sum_faces(d, columns);
      const double of_flux = void_of_flux(own, c, fluid / open);
      double& flux_difference = batch.component[c].flux_difference[q];
      inputs[c].open[q] = open;
      inputs[c].fluid[q] = fluid;
      inputs[c].gain[q] =
          isolated / of_flux * (set_ == fluid::MomentumSet::three ? 1.0 : isolated * open / fluid);
      flux_difference = of_flux * (flux_difference / isolated + disturbance(own, c));
    }
  }
}

inline void DragExchange::add(int d, std::ptrdiff_t face, double open, double eps,
                              const Contribution& weighted) {
  double& coefficient = exchange_.coefficient.component[d][face];
  double& source = exchange_.source.component[d][face];
  if (coefficient == 0.0 && source == 0.0) {
    const double fluid = fluid::fluid_fraction(set_, eps);
    active_[d].push_back({face, fluid * open * lattice_.cell_volume(), 0.0});
  }
  coefficient += eps * weighted.drag;
  source += eps * weighted.push + weighted.extra;
}

template <class Faces>
void DragExchange::scatter_one(int d, const Faces& faces, const Contribution& contribution) {
  for (std::size_t n = 0; n < size(faces); ++n) {
    const double w = faces.weight[n];
    if (faces.open[n] == 0.0 || w == 0.0) continue;
    add(d, faces.storage[n], faces.open[n], faces.void_fraction[n],
        {w * contribution.drag, w * contribution.push, w * contribution.extra});
  }
}

void DragExchange::scatter_smooth(int d, const SmoothKernel& kernel,
                                  const Contribution& contribution) {
  const FaceColumns columns = face_void_.columns(d);
  kernel.for_faces(d, [&](std::ptrdiff_t face, double w) {
    if (w == 0.0 || columns.open[face] == 0.0F) return;
    add(d, face, columns.open[face], columns.void_fraction[face],
        {w * contribution.drag, w * contribution.push, w * contribution.extra});
  });
}

void DragExchange::scatter_groups(int d, const StencilBatch& stencils,
                                  const FaceContributions& contributions) {
  const FaceColumns columns = face_void_.columns(d);
  GroupContributions sum;
  for (std::size_t r = 0; r < stencils.groups; ++r) {
    sum_group(stencils, d, r, contributions, sum);
    std::size_t n = 0;
    for_corners(corners(stencils, d, (d + 1) % 3, (d + 2) % 3, stencils.group[r]),
                [&](std::int32_t face, double) {
                  const Contribution contribution{sum.drag[n], sum.push[n], sum.extra[n]};
                  ++n;
                  const double open = columns.open[face];
                  if (open == 0.0 || (contribution.drag == 0.0 && contribution.extra == 0.0))
                    return;
                  add(d, face, open, columns.void_fraction[face], contribution);
                });
  }
}

// One component is one task and sums in the order of the cells: the same bits on any number of
// threads.
void DragExchange::scatter_component(int d, const FaceStencils& stencils,
                                     const fluid::CellField& eps) {
  const FaceColumns columns = face_void_.columns(d);
  MultiCellKernel multi_cell(lattice_, rule_);
  MultiCellStencil many;
  SmoothKernel smooth(lattice_);
  for (std::size_t b = 0; b < stencils.size(); ++b) {
    const StencilBatch& batch = stencils[b];
    const FaceContributions& contributions = batches_[b].component[d];
    if (has_large_groups(batch) && !batches_[b].has_multi_cell && !batches_[b].has_smooth) {
      scatter_groups(d, batch, contributions);
      continue;
    }
    for (std::size_t q = 0; q < batch.count; ++q) {
      const Contribution contribution{contributions.drag[q],
                                      contributions.drag[q] * contributions.velocity[q],
                                      contributions.extra[q]};
      if (contribution.drag == 0.0 && contribution.extra == 0.0) continue;
      if (batches_[b].is_smooth[q] != 0) {
        smooth.set(batch.position_of(q), 2.0 * batch.radius(q));
        scatter_smooth(d, smooth, contribution);
        continue;
      }
      if (multi_cell.takes(batch.radius(q))) {
        multi_cell.set(batch.position_of(q), batch.radius(q));
        multi_cell.stencil(d, eps, many);
        scatter_one(d, many, contribution);
        continue;
      }
      for_corners(corners(batch, d, (d + 1) % 3, (d + 2) % 3, q), [&](std::int32_t face,
                                                                      double weight) {
        const double open = columns.open[face];
        if (open == 0.0 || weight == 0.0) return;
        add(d, face, open, columns.void_fraction[face],
            {weight * contribution.drag, weight * contribution.push, weight * contribution.extra});
      });
    }
  }
}

/// The residuals of grains that are gone; returns how many find no open face.
std::int64_t DragExchange::release_escaped(int d, ParticleStates& memory, double step) {
  const double volume = lattice_.cell_volume();
  std::int64_t unpaired = 0;
  Stencil s;
  for (const EscapedParticle& l : memory.escaped()) {
    if (l.deferred[d] == 0.0) continue;
    face_void_.stencil(d, lattice_.place(l.place.data()), s);
    const FaceSums sums = sums_of(s);
    if (sums.open <= k_min_weight) {
      ++unpaired;
      continue;
    }
    const double received = set_ == fluid::MomentumSet::three ? sums.open : sums.fluid;
    scatter_one(d, s, {0.0, 0.0, l.deferred[d] / (received * volume * step)});
    released_[d] += l.deferred[d];
  }
  return unpaired;
}

/// Residuals of cells: to either face along the component the half, all to one if the other is
/// closed.
void DragExchange::release_cells(int d, std::vector<double>& per_cell, double step) {
  const FaceColumns columns = face_void_.columns(d);
  const fluid::Grid& grid = lattice_.grid();
  const double impulse = step * lattice_.cell_volume();
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      for (int i = 0; i < grid.count[0]; ++i) {
        double& deferred = per_cell[static_cast<std::size_t>(grid.index(i, j, k))];
        if (deferred == 0.0) continue;
        const std::array<std::ptrdiff_t, 2> faces{lattice_.face(d, i, j, k, 0).storage,
                                                  lattice_.face(d, i, j, k, 1).storage};
        std::array<double, 2> fluid{};
        double open = 0.0;
        for (std::size_t n = 0; n < 2; ++n) {
          const double part = columns.open[faces[n]];
          fluid[n] = part * fluid::fluid_fraction(set_, columns.void_fraction[faces[n]]);
          open += part > 0.0 ? 1.0 : 0.0;
        }
        if (open == 0.0) continue;
        const double released =
            std::abs(deferred) < k_nothing_deferred ? deferred : k_released_share * deferred;
        deferred -= released;
        released_[d] += released;
        for (std::size_t n = 0; n < 2; ++n) {
          if (!(fluid[n] > 0.0)) continue;
          add(d, faces[n], columns.open[faces[n]], columns.void_fraction[faces[n]],
              {0.0, 0.0, released / (open * fluid[n] * impulse)});
        }
      }
    }
  }
}

std::int64_t DragExchange::scatter(const FaceStencils& stencils, ParticleStates& states,
                                   const fluid::CellField& eps, double step,
                                   StressBalance* stress) {
  std::array<std::int64_t, 3> unpaired{};
  tbb::parallel_for(0, 3, [&](int d) {
    clear(d);
    released_[d] = 0.0;
    for (const BatchContributions& batch : batches_) released_[d] += batch.released[d];
    scatter_component(d, stencils, eps);
    unpaired[d] = release_escaped(d, states, step);
    if (stress != nullptr) release_cells(d, stress->deferred(d), step);
    lattice_.close_periodic(d, exchange_.coefficient.component[d]);
    lattice_.close_periodic(d, exchange_.source.component[d]);
  });
  states.escaped().clear();
  std::int64_t all = unpaired[0] + unpaired[1] + unpaired[2];
  for (const BatchContributions& batch : batches_) all += batch.unpaired;
  return all;
}

/// Component d of what a grain's drag has given to the fluid, over its contribution and a cell's
/// volume.
double DragExchange::drag_through(int d, const SmoothKernel& kernel, const std::vector<double>& u,
                                  double velocity, double flux_difference) const {
  const FaceColumns columns = face_void_.columns(d);
  double sum = 0.0;
  kernel.for_faces(d, [&](std::ptrdiff_t face, double w) {
    const double eps = columns.void_fraction[face];
    const double fluid = fluid::fluid_fraction(set_, eps);
    sum += w * columns.open[face] * fluid * (eps * (u[face] - velocity) + flux_difference);
  });
  return sum;
}

double DragExchange::evaluate(const FaceStencils& stencils, std::span<const std::int32_t> rows,
                              ParticleStates& states, const fluid::CellField& eps,
                              const fluid::FaceField& velocity, double step) {
  const FluidAfter after{eps, velocity, step * lattice_.cell_volume()};
  tbb::parallel_for(std::size_t{0}, stencils.size(), [&](std::size_t b) {
    const StencilBatch& here = stencils[b];
    Impulses given;
    evaluate_batch(here, after, batches_[b], given);
    const std::span<const std::int32_t> own = rows.subspan(b * StencilBatch::k_size, here.count);
    for (std::size_t q = 0; q < here.count; ++q) {
      if (own[q] < 0) continue;
      states[static_cast<std::size_t>(own[q])].given = {given[0][q], given[1][q], given[2][q]};
    }
  });
  return imbalance(velocity, step);
}

void DragExchange::evaluate_batch(const StencilBatch& here, const FluidAfter& fluid,
                                  BatchContributions& batch, Impulses& given) const {
  SmoothKernel smooth(lattice_);
  const bool is_density = set_ == fluid::MomentumSet::three;
  batch.given = batch.size = {};
  for (int d = 0; d < 3; ++d) {
    const FaceContributions& own = batch.component[d];
    evaluate_faces(here, d, face_void_.columns(d), fluid.velocity.component[d].data(), own,
                   fluid.impulse, is_density, given[d].data());
    if (batch.has_multi_cell) evaluate_multi_cell(here, d, fluid, batch, given);
  }
  for (std::size_t q = 0; batch.has_smooth && q < here.count; ++q) {
    if (batch.is_smooth[q] == 0) continue;
    smooth.set(here.position_of(q), 2.0 * here.radius(q));
    for (int d = 0; d < 3; ++d) {
      const FaceContributions& own = batch.component[d];
      given[d][q] = fluid.impulse * own.drag[q] *
                    drag_through(d, smooth, fluid.velocity.component[d], own.velocity[q],
                                 own.flux_difference[q]);
    }
  }
  for (int d = 0; d < 3; ++d) {
    for (std::size_t q = 0; q < here.count; ++q) {
      batch.given[d] += given[d][q];
      batch.size[d] += std::abs(given[d][q]);
    }
  }
}

/// Component d of the particles larger than a cell.
void DragExchange::evaluate_multi_cell(const StencilBatch& here, int d, const FluidAfter& after,
                                       const BatchContributions& batch, Impulses& given) const {
  const std::vector<double>& u = after.velocity.component[d];
  const FaceContributions& own = batch.component[d];
  MultiCellKernel multi_cell(lattice_, rule_);
  MultiCellStencil many;
  for (std::size_t q = 0; q < here.count; ++q) {
    if (!multi_cell.takes(here.radius(q)) || batch.is_smooth[q] != 0) continue;
    multi_cell.set(here.position_of(q), here.radius(q));
    multi_cell.stencil(d, after.eps, many);
    double sum = 0.0;
    for (std::size_t n = 0; n < size(many); ++n) {
      const double fluid = fluid::fluid_fraction(set_, many.void_fraction[n]);
      const double slip = many.void_fraction[n] * (u[many.storage[n]] - own.velocity[q]);
      sum += many.weight[n] * many.open[n] * fluid * (slip + own.flux_difference[q]);
    }
    given[d][q] = after.impulse * own.drag[q] * sum;
  }
}

/// Finds the forces on the faces, and compares the sums: |difference| / scale.
double DragExchange::imbalance(const fluid::FaceField& velocity, double step) {
  std::array<double, 3> difference{};
  std::array<double, 3> scale{};
  tbb::parallel_for(0, 3, [&](int d) {
    double on_grains = -released_[d];
    double size = std::abs(released_[d]);
    for (const BatchContributions& batch : batches_) {
      on_grains += batch.given[d];
      size += batch.size[d];
    }
    double on_fluid = 0.0;
    for (ActiveFace& t : active_[d]) {
      t.force =
          t.volume * (exchange_.source.component[d][t.face] -
                      exchange_.coefficient.component[d][t.face] * velocity.component[d][t.face]);
      on_fluid += step * t.force;
      size += step * std::abs(t.force);
    }
    difference[d] = std::abs(on_fluid + on_grains);
    scale[d] = size;
  });
  const double size = std::max({scale[0], scale[1], scale[2]});
  return size > 0.0 ? std::max({difference[0], difference[1], difference[2]}) / size : 0.0;
}

void DragExchange::per_cell(std::vector<float>& values) const {
  const fluid::Grid& grid = lattice_.grid();
  const auto number = [&](std::array<int, 3> c) {
    return c[0] + static_cast<std::size_t>(grid.count[0]) *
                      (c[1] + static_cast<std::size_t>(grid.count[1]) * c[2]);
  };
  values.assign(3 * static_cast<std::size_t>(grid.count[0]) * grid.count[1] * grid.count[2], 0.0F);
  for (int d = 0; d < 3; ++d) {
    for (const ActiveFace& t : active_[d]) {
      const float half = static_cast<float>(0.5 * t.force / lattice_.cell_volume());
      const std::array<int, 3> upper = lattice_.indices(t.face);
      const std::ptrdiff_t lower =
          lattice_.cell(upper[0] - (d == 0), upper[1] - (d == 1), upper[2] - (d == 2));
      values[3 * number(upper) + d] += half;
      values[3 * number(lattice_.indices(lower)) + d] += half;
    }
  }
}

}  // namespace dust::coupling

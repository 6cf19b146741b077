// SPDX-License-Identifier: Apache-2.0
#include "coupling/flow_sampler.hpp"

#include <algorithm>

namespace dust::coupling {

FlowSampler::FlowSampler(const CouplingScene& scene, SelfDisturbance& self)
    : lattice_(scene.lattice),
      voidage_(scene.voidage),
      set_(scene.drag.momentum_set()),
      void_fraction_(scene.void_fraction),
      face_void_(scene.face_void),
      self_(self),
      states_(scene.states),
      needs_stress_(set_ != fluid::MomentumSet::three) {}

void FlowSampler::sample(const ParticleBatch& batch, const FluidState& state, SampledFlow& flow,
                         DragColumns& columns) const {
  const StencilBatch& here = batch.here;
  const bool has_multi_cell = sample_cells(here, batch.size(), state, flow, columns);
  std::array<StencilBatch::Reals, 3> v;
  for (std::size_t q = 0; q < batch.size(); ++q) {
    const double* velocity = batch.grains.velocity_of(batch.row(q));
    for (std::size_t d = 0; d < 3; ++d) v[d][q] = velocity[d];
  }
  StencilBatch::Reals open;
  StencilBatch::Reals fluid;
  StencilBatch::Reals flux;  // relative to the particle: it does not jump with eps in plug flow
  for (int d = 0; d < 3; ++d) {
    sample_faces(here, d, face_void_.columns(d), state.velocity.component[d].data(), v[d].data(),
                 {open.data(), fluid.data()}, flux.data());
    if (has_multi_cell) {
      sample_multi_cell(here, d, state, v[d].data(),
                        {{open.data(), fluid.data()}, flux.data(), flow.stress[d].data()});
    }
    double* slip = flow.slip[d].data();
    double* ratio = flow.ratio[d].data();
    slip_of_faces(batch.size(), columns.void_fraction.data(), {open.data(), fluid.data()},
                  flux.data(), slip, ratio);
    if (set_ == fluid::MomentumSet::three) std::fill_n(ratio, batch.size(), 1.0);
  }
  if (states_.has_self_flow()) self_.sample(batch, state, needs_stress_, v, flow, columns);
}

/// Void fraction and stress of the cells that the particles of a batch are in; returns whether some
/// of them are larger than a cell.
bool FlowSampler::sample_cells(const StencilBatch& here, std::size_t count, const FluidState& state,
                               SampledFlow& flow, DragColumns& columns) const {
  MultiCellKernel multi_cell(lattice_, voidage_);
  bool has_multi_cell = false;
  // Particles of one cell come one after another.
  std::ptrdiff_t last_cell = -1;
  double eps = 1.0;
  Triple stress{};
  for (std::size_t q = 0; q < count; ++q) {
    const std::ptrdiff_t cell = cell_of(here, q);
    const bool is_multi_cell = multi_cell.takes(here.radius(q));
    has_multi_cell = has_multi_cell || is_multi_cell;
    if (cell != last_cell || is_multi_cell) {
      last_cell = is_multi_cell ? -1 : cell;
      eps = void_fraction_.around(here.position_of(q), cell, multi_cell);
      for (int d = 0; needs_stress_ && d < 3; ++d) {
        stress[d] = lattice_.face_mean(d, cell, cell + here.face_step[d][q],
                                       state.stress_divergence.component[d]);
      }
    }
    columns.void_fraction[q] = eps;
    for (std::size_t d = 0; d < 3; ++d) flow.stress[d][q] = stress[d];
  }
  return has_multi_cell;
}

/// Component d of what the particles larger than a cell see.
void FlowSampler::sample_multi_cell(const StencilBatch& here, int d, const FluidState& state,
                                    const double* v, const ComponentColumns& out) const {
  const auto& [sums, flux, stress] = out;
  const std::vector<double>& u = state.velocity.component[d];
  const std::vector<double>& push = state.stress_divergence.component[d];
  MultiCellKernel multi_cell(lattice_, voidage_);
  MultiCellStencil many;
  for (std::size_t q = 0; q < here.count; ++q) {
    if (!multi_cell.takes(here.radius(q))) continue;
    multi_cell.set(here.position_of(q), here.radius(q));
    multi_cell.stencil(d, void_fraction_.after(), many);
    sums.open[q] = sums.fluid[q] = flux[q] = stress[q] = 0.0;
    for (std::size_t n = 0; n < size(many); ++n) {
      flux[q] += many.weight[n] * many.void_fraction[n] * (u[many.storage[n]] - v[q]);
      const double part = many.weight[n] * many.open[n];
      sums.open[q] += part;
      sums.fluid[q] += part * many.void_fraction[n];
      if (needs_stress_ && many.open[n] > 0.0) stress[q] += many.weight[n] * push[many.storage[n]];
    }
  }
}

}  // namespace dust::coupling

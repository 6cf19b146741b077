// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/face_stencils.hpp"

#include <array>

namespace dust::coupling {
namespace {

/// Particles between the one that is looked at and the one that is fetched.
constexpr std::size_t k_ahead = 12;

}  // namespace

void FaceStencils::sort(const fluid::Grid& grid, const particles::GrainRows& grains,
                        std::uint64_t order) {
  order_.sort(grid, grains.position, grains.count);
  state_order_ = order;
  batches_.resize((grains.count + StencilBatch::k_size - 1) / StencilBatch::k_size);
}

const StencilBatch& FaceStencils::locate(const Lattice& lattice, const particles::GrainRows& grains,
                                         std::size_t number, double ahead) {
  const Rows of_batch = rows(number);
  StencilBatch& batch = batches_[number];
  bool is_other = batch.count != of_batch.size();
  double* known = batch.position.data();
  const std::array<double, 4> times{ahead, ahead, ahead, 0.0};
  for (std::size_t q = 0; q < of_batch.size(); ++q) {
    const std::int32_t row = of_batch[q];
    if (q + k_ahead < of_batch.size()) {
      // Rows in the order of the cells lie anywhere: many are fetched at a time.
      const auto next = static_cast<std::size_t>(of_batch[q + k_ahead]);
      __builtin_prefetch(grains.position_of(next));
      __builtin_prefetch(grains.velocity_of(next));
    }
    const double* position = grains.position_of(static_cast<std::size_t>(row));
    const double* velocity = grains.velocity_of(static_cast<std::size_t>(row));
    for (std::size_t n = 0; n < 4; ++n) {
      const double moved = position[n] + times[n] * velocity[n];
      is_other |= known[n] != moved;
      known[n] = moved;
    }
    known += 4;
  }
  // Particles that lie still are where they were.
  if (!is_other) return batch;
  batch.count = of_batch.size();
  lattice.place(batch);
  return batch;
}

}  // namespace dust::coupling

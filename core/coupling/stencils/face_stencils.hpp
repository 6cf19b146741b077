// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/stencils/cell_order.hpp"
#include "coupling/stencils/lattice.hpp"
#include "particles/grain_rows.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::coupling {

/// Particles that are worked on together.
struct ParticleBatch {
  const particles::GrainRows& grains;  ///< all
  std::span<const std::int32_t> rows;  ///< which of them
  const StencilBatch& here;            ///< the faces around each

  [[nodiscard]] std::size_t size() const { return rows.size(); }
  [[nodiscard]] std::size_t row(std::size_t q) const { return static_cast<std::size_t>(rows[q]); }
};

/// The faces around particles, batch by batch in the order of the cells they lie in.
class FaceStencils {
 public:
  using Rows = std::span<const std::int32_t>;

  /// Orders the particles by their cells; `order` is ParticleStates::order() now.
  void sort(const fluid::Grid& grid, const particles::GrainRows& grains, std::uint64_t order);
  /// Whether they are ordered as the particles are numbered now.
  [[nodiscard]] bool are_in_order(std::uint64_t order, std::size_t count) const {
    return state_order_ == order && order_.rows().size() == count;
  }
  [[nodiscard]] std::uint64_t order() const { return state_order_; }

  [[nodiscard]] std::size_t size() const { return batches_.size(); }
  [[nodiscard]] const StencilBatch& operator[](std::size_t batch) const { return batches_[batch]; }
  /// The particles of all batches one after another, and of one.
  [[nodiscard]] Rows rows() const { return order_.rows(); }
  [[nodiscard]] Rows rows(std::size_t batch) const {
    const std::size_t first = batch * StencilBatch::k_size;
    return rows().subspan(first, std::min(StencilBatch::k_size, rows().size() - first));
  }

  /// Makes the stencils of a batch those of its particles, moved on for `ahead` [s].
  const StencilBatch& locate(const Lattice& lattice, const particles::GrainRows& grains,
                             std::size_t batch, double ahead = 0.0);

  /// Runs work(batch, rows) over the batches.
  template <class Work>
  void for_batches(const Work& work) const {
    tbb::parallel_for(std::size_t{0}, batches_.size(), [&](std::size_t b) { work(b, rows(b)); });
  }

 private:
  CellOrder order_;
  std::vector<StencilBatch> batches_;
  std::uint64_t state_order_ = 0;
};

}  // namespace dust::coupling

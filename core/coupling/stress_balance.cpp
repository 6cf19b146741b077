// SPDX-License-Identifier: Apache-2.0
#include "coupling/stress_balance.hpp"

#include "dust/sdk/error.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <string>

namespace dust::coupling {

StressBalance::StressBalance(const Lattice& lattice, const sdk::VoidageRule& rule)
    : lattice_(lattice), rule_(rule) {
  for (auto& component : deferred_) component.assign(lattice.grid().size, 0.0);
}

void StressBalance::leave(const fluid::CellField& eps, const fluid::FaceField& stress,
                          double step) {
  const double impulse = step * lattice_.cell_volume();
  lattice_.for_cells([&](int i, int j, int k, std::ptrdiff_t cell) {
    const double solids = (1.0 - eps[cell]) * lattice_.open_fraction(cell);
    if (solids == 0.0) return;
    for (int d = 0; d < 3; ++d) {
      const auto c = static_cast<std::size_t>(d);
      const std::ptrdiff_t low = lattice_.face(d, i, j, k, 0).storage;
      const std::ptrdiff_t high = lattice_.face(d, i, j, k, 1).storage;
      deferred_[c][cell] +=
          impulse * solids * lattice_.face_mean(d, low, high, stress.component[c]);
    }
  });
}

void StressBalance::receive(const FaceStencils& stencils, FaceStencils::Rows now,
                            std::span<const Triple> impulse) {
  // Components share nothing, and each sums in the order of the cells: the same bits on any number
  // of threads. On one thread all go in one pass.
  if (tbb::this_task_arena::max_concurrency() == 1) {
    receive(stencils, now, impulse, 0, 3);
    return;
  }
  tbb::parallel_for(std::size_t{0}, std::size_t{3},
                    [&](std::size_t d) { receive(stencils, now, impulse, d, d + 1); });
}

/// The components from `first` to `end`.
void StressBalance::receive(const FaceStencils& stencils, FaceStencils::Rows now,
                            std::span<const Triple> impulse, std::size_t first, std::size_t end) {
  MultiCellKernel multi_cell(lattice_, rule_);
  // Particles of one cell come one after another: its residual stays in the registers meanwhile.
  std::ptrdiff_t cell = -1;
  Triple deferred{};
  const auto put_back = [&] {
    if (cell < 0) return;
    for (std::size_t d = first; d < end; ++d)
      deferred_[d][static_cast<std::size_t>(cell)] = deferred[d];
  };
  for (std::size_t b = 0; b < stencils.size(); ++b) {
    const StencilBatch& batch = stencils[b];
    const FaceStencils::Rows rows = now.subspan(b * StencilBatch::k_size, batch.count);
    for (std::size_t q = 0; q < batch.count; ++q) {
      if (rows[q] < 0) continue;
      const Triple& received = impulse[static_cast<std::size_t>(rows[q])];
      if (multi_cell.takes(batch.radius(q))) {
        put_back();
        cell = -1;
        multi_cell.set(batch.position_of(q), batch.radius(q));
        for (const MultiCellKernel::Share& share : multi_cell.shares()) {
          for (std::size_t d = first; d < end; ++d) {
            deferred_[d][share.cell] -= share.weight * received[d];
          }
        }
        continue;
      }
      if (const std::ptrdiff_t own = cell_of(batch, q); own != cell) {
        put_back();
        cell = own;
        for (std::size_t d = first; d < end; ++d) {
          deferred[d] = deferred_[d][static_cast<std::size_t>(cell)];
        }
      }
      for (std::size_t d = first; d < end; ++d) deferred[d] -= received[d];
    }
  }
  put_back();
}

void StressBalance::save(sdk::ArchiveWriter& archive) const {
  for (std::size_t d = 0; d < 3; ++d) {
    archive.numbers(std::string("stress_owed_") + "xyz"[d], deferred_[d]);
  }
}

void StressBalance::load(sdk::ArchiveReader& archive) {
  for (std::size_t d = 0; d < 3; ++d) {
    auto values = archive.numbers(std::string("stress_owed_") + "xyz"[d]);
    if (values.size() != deferred_[d].size()) {
      throw sdk::ModelError("the checkpoint's stress balance belongs to another grid");
    }
    deferred_[d] = std::move(values);
  }
}

}  // namespace dust::coupling

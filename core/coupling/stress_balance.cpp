// SPDX-License-Identifier: Apache-2.0
#include "coupling/stress_balance.hpp"

#include "dust/sdk/error.hpp"

#include <tbb/parallel_for.h>

#include <string>

namespace dust::coupling {

StressBalance::StressBalance(const Lattice& lattice, const sdk::VoidageRule& rule)
    : lattice_(lattice), rule_(rule) {
  for (auto& component : owed_) component.assign(lattice.grid().size, 0.0);
}

void StressBalance::leave(const fluid::CellField& eps, const fluid::FaceField& stress,
                          double step) {
  const double impulse = step * lattice_.cell_volume();
  lattice_.for_cells([&](int i, int j, int k, std::ptrdiff_t cell) {
    const double solids = (1.0 - eps[cell]) * lattice_.open_fraction(cell);
    if (solids == 0.0) return;
    for (int d = 0; d < 3; ++d) {
      const auto c = static_cast<std::size_t>(d);
      const std::ptrdiff_t low = lattice_.face(d, i, j, k, 0).home;
      const std::ptrdiff_t high = lattice_.face(d, i, j, k, 1).home;
      owed_[c][cell] += impulse * solids * lattice_.face_mean(d, low, high, stress.component[c]);
    }
  });
}

void StressBalance::receive(const FaceStencils& stencils, std::span<const Triple> impulse) {
  // One component is one task and sums in the order of the cells: the same bits on any number of
  // threads.
  tbb::parallel_for(std::size_t{0}, std::size_t{3}, [&](std::size_t d) {
    WideKernel wide(lattice_, rule_);
    for (std::size_t b = 0; b < stencils.size(); ++b) {
      const StencilBatch& batch = stencils[b];
      const std::span<const std::int32_t> rows = stencils.rows(b);
      for (std::size_t q = 0; q < batch.count; ++q) {
        const double received = impulse[static_cast<std::size_t>(rows[q])][d];
        const double* position = &batch.position[4 * q];
        if (!wide.takes(position[3])) {
          owed_[d][cell_of(batch, q)] -= received;
          continue;
        }
        wide.set(position, position[3]);
        for (const WideKernel::Share& share : wide.shares()) {
          owed_[d][share.cell] -= share.weight * received;
        }
      }
    }
  });
}

void StressBalance::save(sdk::ArchiveWriter& archive) const {
  for (std::size_t d = 0; d < 3; ++d) {
    archive.numbers(std::string("stress_owed_") + "xyz"[d], owed_[d]);
  }
}

void StressBalance::load(sdk::ArchiveReader& archive) {
  for (std::size_t d = 0; d < 3; ++d) {
    auto values = archive.numbers(std::string("stress_owed_") + "xyz"[d]);
    if (values.size() != owed_[d].size()) {
      throw sdk::ModelError("the checkpoint's stress book belongs to another grid");
    }
    owed_[d] = std::move(values);
  }
}

}  // namespace dust::coupling

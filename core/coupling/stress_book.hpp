// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/cell_order.hpp"
#include "coupling/face_exchange.hpp"
#include "coupling/lattice.hpp"
#include "coupling/wide_kernel.hpp"
#include "dust/sdk/archive.hpp"

#include <array>
#include <span>
#include <vector>

namespace dust::coupling {

/// Force of the pressure and the viscous stress on the grains, on either side: the fluid leaves
/// them (1 - eps) of it in every cell, as it is solved; they receive V_i of that where they are
/// looked at. The difference is owed to the fluid, cell by cell (docs/theory/coupling.md, Time).
class StressBook {
 public:
  StressBook(const Lattice& lattice, const sdk::VoidageRule& rule);

  /// What the fluid leaves to the grains over `step` [s]: in each cell half of the stress at either
  /// face, times the volume of the grains.
  void leave(const fluid::CellField& eps, const fluid::FaceField& stress, double step);
  /// What grains have received: `impulse` [N s] per row, weight included, in the order of `spots`.
  void receive(const Spots& spots, std::span<const Triple> impulse);
  /// Owed to the fluid [N s], component d, per padded cell.
  [[nodiscard]] std::vector<double>& owed(int d) { return owed_[static_cast<std::size_t>(d)]; }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  const Lattice& lattice_;
  const sdk::VoidageRule& rule_;
  std::array<std::vector<double>, 3> owed_;
};

}  // namespace dust::coupling

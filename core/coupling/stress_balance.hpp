// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/particle_states.hpp"
#include "coupling/stencils/face_stencils.hpp"
#include "coupling/stencils/lattice.hpp"
#include "coupling/stencils/multi_cell_kernel.hpp"
#include "dust/sdk/archive.hpp"

#include <array>
#include <span>
#include <vector>

namespace dust::coupling {

/// Force of the pressure and the viscous stress on the grains, on either side: the fluid leaves
/// them (1 - eps) of it in every cell, as it is solved; they receive V_i of that where they are
/// looked at. The fluid receives the difference later; docs/theory/coupling.md, eq. (19).
class StressBalance {
 public:
  StressBalance(const Lattice& lattice, const sdk::VoidageRule& rule);

  /// What the fluid leaves to the grains over `step` [s]: in each cell half of the stress at either
  /// face, times the volume of the grains.
  void leave(const fluid::CellField& eps, const fluid::FaceField& stress, double step);
  /// Room for what each of `count` particles receives in a step.
  [[nodiscard]] std::span<Triple> room_for(std::size_t count) {
    received_.resize(count);
    return received_;
  }
  /// What they have received: `impulse` [N s] per particle, weight included, at these stencils, of
  /// particles whose rows are `now` others; -1 for those that are gone.
  void receive(const FaceStencils& stencils, FaceStencils::Rows now,
               std::span<const Triple> impulse);
  /// Owed to the fluid [N s], component d, per padded cell.
  [[nodiscard]] std::vector<double>& deferred(int d) {
    return deferred_[static_cast<std::size_t>(d)];
  }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  void receive(const FaceStencils& stencils, FaceStencils::Rows now,
               std::span<const Triple> impulse, std::size_t first, std::size_t end);

  const Lattice& lattice_;
  const sdk::VoidageRule& rule_;
  std::array<std::vector<double>, 3> deferred_;
  std::vector<Triple> received_;  ///< [N s] storage of room_for()
};

}  // namespace dust::coupling

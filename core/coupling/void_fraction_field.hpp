// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/stencils/lattice.hpp"
#include "coupling/stencils/multi_cell_kernel.hpp"
#include "dust/sdk/voidage_rule.hpp"
#include "particles/grain_rows.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dust::coupling {

/// Void fraction below which a cell gives grain volume to its neighbours [-]. Spheres pack to 0.36
/// at random and 0.26 in the densest order; less in a cell cut by a body is the rule's doing, not
/// the packing's, and drag laws are singular at 0.
inline constexpr double k_smallest_void_fraction = 0.30;

/// Void fraction of the open volume of each cell; docs/theory/coupling.md, eq. (10).
class VoidFractionField {
 public:
  struct Counts {
    std::int64_t moved_shares = 0;
    std::int64_t limited_cells = 0;
    std::int64_t unplaced_grains = 0;
    double smallest = 1.0;
    double largest_ratio = 0.0;   ///< D / dx
    std::size_t largest_row = 0;  ///< row of the grain with that ratio
  };

  VoidFractionField(const Lattice& lattice, const sdk::VoidageRule& rule);

  /// The rule's shares of every grain (times its weight), summed in row order.
  Counts deposit(const particles::GrainRows& grains);
  /// Adds solids [m3], which may be negative, to a cell after deposit(), where a grain is not
  /// spread by the rule.
  void add_after(std::ptrdiff_t cell, double volume);
  /// Solids [m3] of filled_cells().
  [[nodiscard]] std::vector<double> solids() const;
  /// after() of the same solids in cells of another open volume: a body was taken away.
  void keep_solids(const std::vector<double>& solids);
  [[nodiscard]] const fluid::CellField& before() const { return before_.eps; }
  [[nodiscard]] const fluid::CellField& after() const { return after_.eps; }
  /// Void fraction that a particle in the cell `own` has around it, by its row of position and
  /// radius; sets `multi_cell` for one larger than a cell.
  [[nodiscard]] double around(const double* position, std::ptrdiff_t own,
                              MultiCellKernel& multi_cell) const {
    if (!multi_cell.takes(position[3])) return after()[lattice_.host_cell(own, position)];
    multi_cell.set(position, position[3]);
    return std::min(1.0, multi_cell.mean(after()));  // weights sum to 1 but for rounding
  }
  /// Cells in which after() may differ from 1.
  [[nodiscard]] const std::vector<std::ptrdiff_t>& filled_cells() const { return after_.active; }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  struct Share {
    std::ptrdiff_t cell;
    double volume;
  };
  /// Of an overfull cell to a neighbour.
  struct Transfer {
    std::ptrdiff_t from;
    std::ptrdiff_t to;
    double volume;  ///< [m3]
  };
  /// A field that is 1 except in the cells listed.
  struct State {
    fluid::CellField eps;
    std::vector<std::ptrdiff_t> active;
  };

  void spread(const particles::GrainRows& grains, std::size_t first, std::size_t last,
              std::vector<Share>& shares, Counts& counts) const;
  void take_shares(const particles::GrainRows& grains, std::size_t first,
                   const sdk::VoidageBatch& batch, std::vector<Share>& shares,
                   Counts& counts) const;
  void add(std::ptrdiff_t cell, double volume);
  [[nodiscard]] double room(std::ptrdiff_t cell) const;
  bool find_transfers();
  std::int64_t redistribute_excess();

  const Lattice& lattice_;
  const sdk::VoidageRule& rule_;
  State before_;
  State after_;
  fluid::CellField volume_;   ///< [m3] of grains per cell; zero between calls
  fluid::CellField offered_;  ///< [m3] by overfull neighbours; zero between calls
  std::vector<Transfer> transfers_;
  std::vector<std::vector<Share>> shares_;
};

}  // namespace dust::coupling

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/stencils/lattice.hpp"
#include "dust/sdk/voidage_rule.hpp"

#include <vector>

namespace dust::coupling {

/// As Stencil, of any number of faces.
struct MultiCellStencil {
  std::vector<std::ptrdiff_t> storage;
  std::vector<double> weight, void_fraction, open;
};
[[nodiscard]] inline std::size_t size(const MultiCellStencil& s) { return s.storage.size(); }

/// The cells over which a grain larger than a cell is spread by the voidage rule, and the faces
/// through which it is coupled: each cell gives half of its share to either face along the
/// component. The same weights gather the fluid's velocity and spread the force.
class MultiCellKernel {
 public:
  MultiCellKernel(const Lattice& lattice, const sdk::VoidageRule& rule);

  /// Whether a grain is coupled over its cells, not through the eight faces around its centre.
  [[nodiscard]] bool takes(double radius) const { return 2.0 * radius > largest_; }

  /// Looks at a grain; `position` [m] of its centre. One that has no open cell around has all of
  /// the one nearest to it.
  void set(const double* position, double radius);
  /// Faces of component d, with void fractions from the padded field `eps`.
  void stencil(int d, const fluid::CellField& eps, MultiCellStencil& s) const;
  /// Mean of a padded field over the cells.
  [[nodiscard]] double mean(const fluid::CellField& field) const;
  struct Share {
    int i, j, k;
    std::ptrdiff_t cell;
    double weight;  ///< sum 1
  };
  [[nodiscard]] const std::vector<Share>& shares() const { return shares_; }

 private:
  const Lattice& lattice_;
  const sdk::VoidageRule& rule_;
  double largest_;
  std::vector<Share> shares_;
  std::vector<int> i_, j_, k_;
  std::vector<double> weight_;
};

}  // namespace dust::coupling

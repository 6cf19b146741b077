// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/stencils/lattice.hpp"

#include <array>
#include <vector>

namespace dust::coupling {

/// Void fraction of the faces, the mean of their two cells: once per fluid step for all faces, in
/// place of once per grain, and with what else a grain looks up at its faces.
class FaceVoidFraction {
 public:
  explicit FaceVoidFraction(const Lattice& lattice);

  /// `eps` differs from 1 in the cells `active` alone.
  void update(const fluid::CellField& eps, const std::vector<std::ptrdiff_t>& active);

  /// Faces of component d around `p`; a field is read where it is accounted.
  void stencil(int d, const Place& p, Stencil& s) const {
    lattice_.faces(d, p, s);
    const double* eps = value_[d].data();
    const float* open = lattice_.open_shares(d);
    for (std::size_t n = 0; n < size(s); ++n) {
      s.void_fraction[n] = eps[s.storage[n]];
      s.open[n] = open[s.storage[n]];
    }
  }

  /// For the kernels over batches of grains.
  [[nodiscard]] FaceColumns columns(int d) const {
    return {value_[d].data(), lattice_.open_shares(d)};
  }

 private:
  void set_faces(int d, std::array<int, 3> cell, const fluid::CellField& eps);

  const Lattice& lattice_;
  std::array<std::vector<double>, 3> value_;               ///< 1 but for those listed
  std::array<std::vector<std::ptrdiff_t>, 3> is_not_one_;  ///< homes
};

}  // namespace dust::coupling

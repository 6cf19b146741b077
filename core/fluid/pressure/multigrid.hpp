// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace dust::fluid {

/// Padded block of one multigrid level, in single precision.
struct MultigridLevel {
  std::array<int, 3> count{1, 1, 1};
  std::array<double, 3> spacing{1, 1, 1};
  std::array<bool, 3> is_periodic{false, false, false};
  std::array<int, 3> factor{1, 1, 1};  ///< cells joined per direction for the next level
  bool is_flat = false;                ///< one cell in y and no fluid through its faces there
  std::ptrdiff_t start = 0;            ///< index of cell (0, 0, 0)
  std::array<std::ptrdiff_t, 3> stride{1, 1, 1};
  std::vector<float> face[3];  ///< coefficient of the lower face; the last one in the halo
  std::vector<float> inverse_diagonal;
  std::vector<float> x;
  std::vector<float> b;
  std::vector<float> mask;  ///< 0 where the coarse correction is not taken
};
[[nodiscard]] inline std::ptrdiff_t index_of(const MultigridLevel& l, int i, int j, int k) {
  return l.start + i + l.stride[1] * j + l.stride[2] * k;
}

/// One cycle of multigrid for  sum_f k_f (x - x_neighbour) = b  on a box of cells with k_f >= 0:
/// piecewise constant transfer, red-black Gauss-Seidel W(2,2), symmetric, so that it can
/// precondition conjugate gradients. A coarse face has half the sum of its fine faces (twice the
/// distance). Cells that are not joined to the rest of their aggregate through open faces take no
/// coarse correction: without that the number of iterations grows four-fold next to bodies.
/// Only directions with (nearly) the smallest spacing are coarsened, so stretched cells are no
/// harm.
class Multigrid {
 public:
  /// `finest` has its layout and a face pattern (0 = closed for ever); masks follow from it.
  explicit Multigrid(MultigridLevel finest);

  MultigridLevel& finest() { return *levels_.front(); }
  /// After the finest level's faces have changed.
  void prepare();
  /// finest().x = about the solution for finest().b.
  void cycle();

 private:
  void build_masks(MultigridLevel& fine) const;
  void coarsen_faces(const MultigridLevel& fine, MultigridLevel& coarse) const;
  static void invert_diagonal(MultigridLevel& level);
  static void wrap(MultigridLevel& level, std::vector<float>& values);
  void smooth(MultigridLevel& level, int colour, bool from_zero) const;
  void restrict_residual(std::size_t l);
  void prolong(std::size_t l);
  void cycle(std::size_t l, bool from_zero);

  std::vector<std::unique_ptr<MultigridLevel>> levels_;
};

}  // namespace dust::fluid

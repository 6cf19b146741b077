// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"
#include "fluid/pressure/multigrid.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace dust::fluid {

/// Solves  sum_f k_f (x - x_neighbour) = b  on the open cells of the grid: conjugate gradients in
/// double precision, preconditioned by one multigrid cycle in single precision. Dot products are
/// added in fixed order: the same bits on any number of threads.
/// A face on a side of the domain with k > 0 joins the cell to x = 0 outside. Regions without such
/// a face are singular: the mean of b over the region is taken out, and so is that of x.
class PressureSolver {
 public:
  struct Result {
    int iterations = 0;
    double relative_residual = 0.0;
  };

  /// `pattern`: faces with a positive number may ever be open (set both ends where periodic).
  PressureSolver(const Grid& grid, const FaceField& pattern);

  /// Coefficients k at faces, to be filled before `prepare`; faces closed in the pattern stay 0.
  FaceField& coefficients() { return k_; }
  void prepare();
  /// Changes `b` (mean taken out). Throws sdk::ModelError when it does not converge.
  Result solve(CellField& b, double tolerance, CellField& x);

  [[nodiscard]] bool is_open(std::ptrdiff_t cell) const { return region_[cell] >= 0; }
  [[nodiscard]] bool is_singular() const { return !singular_regions_.empty(); }
  /// Rooms are the regions without a datum, numbered from 0.
  [[nodiscard]] std::size_t rooms() const { return singular_regions_.size(); }
  /// The room that a cell belongs to, -1: none.
  [[nodiscard]] std::int32_t room(std::ptrdiff_t cell) const;

 private:
  void find_regions(const FaceField& pattern);
  void take_mean_out(CellField& values) const;
  void wrap(CellField& values) const;
  double make_solvable(CellField& r);
  [[nodiscard]] double squares(const CellField& r);
  void precondition(const CellField& r, double scale);
  double apply(const CellField& p);

  Grid grid_;
  bool is_flat_ = false;  ///< nothing passes along y
  FaceField k_;
  std::vector<std::int32_t> region_;  ///< per cell, -1 = closed
  std::vector<std::int32_t> singular_regions_;
  std::unique_ptr<Multigrid> multigrid_;
  CellField direction_;
  CellField image_;
  std::vector<double> partial_;
};

}  // namespace dust::fluid

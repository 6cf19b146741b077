// SPDX-License-Identifier: Apache-2.0
#include "run/snapshots/face_table.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace dust::run {
namespace {

/// Void fraction in the face across `d` below the cell at `o`, which is face number `along` of its
/// row: between those of the two cells. Outside a side there is the fluid of the cell inside, or
/// that of the other end.
double void_fraction_in_face(const fluid::Grid& grid, const fluid::CellField& cells, int d,
                             int along, std::ptrdiff_t o) {
  const std::ptrdiff_t s = grid.stride[d];
  const int n = grid.count[d];
  const std::ptrdiff_t outside = grid.is_periodic[d] ? s * n : s;
  const std::ptrdiff_t below = along == 0 ? o - s + outside : o - s;
  const std::ptrdiff_t above = along == n ? o - outside : o;
  return 0.5 * (cells[static_cast<std::size_t>(below)] + cells[static_cast<std::size_t>(above)]);
}

}  // namespace

FaceTable::FaceTable(const fluid::Grid& grid) : grid_(grid), throughflow_(grid) {
  for (int d = 0; d < 3; ++d) {
    std::size_t faces = 1;
    for (int e = 0; e < 3; ++e) faces *= static_cast<std::size_t>(grid.count[e] + (e == d ? 1 : 0));
    for (auto* column : {&faces_[d].flux, &faces_[d].open, &faces_[d].void_fraction}) {
      column->resize(faces);
    }
  }
}

void FaceTable::publish(fluid::FluidSolver& solver, const fluid::CellField& void_fraction,
                        Moment moment) {
  const fluid::FaceField open = solver.passable_area();
  if (moment == Moment::after_step) {
    solver.find_throughflow(throughflow_);
  } else {
    throughflow_ = solver.velocity();
  }
  for (int d = 0; d < 3; ++d) {
    const int rows = grid_.count[1] + (d == 1 ? 1 : 0);
    tbb::parallel_for(0, grid_.count[2] + (d == 2 ? 1 : 0), [&](int k) {
      for (int j = 0; j < rows; ++j) publish_row(d, j, k, open, void_fraction);
    });
    if (moment == Moment::after_step) continue;
    Faces& faces = faces_[d];
    for (std::size_t n = 0; n < faces.flux.size(); ++n) {
      faces.flux[n] *= faces.open[n] * faces.void_fraction[n];
    }
  }
}

void FaceTable::publish_row(int d, int j, int k, const fluid::FaceField& open,
                            const fluid::CellField& void_fraction) {
  const int row = grid_.count[0] + (d == 0 ? 1 : 0);
  const int rows = grid_.count[1] + (d == 1 ? 1 : 0);
  const std::ptrdiff_t from = grid_.index(0, j, k);
  const std::size_t to =
      static_cast<std::size_t>(row) *
      (static_cast<std::size_t>(j) + static_cast<std::size_t>(rows) * static_cast<std::size_t>(k));
  const int place[3] = {0, j, k};
  Faces& faces = faces_[d];
  for (int i = 0; i < row; ++i) {
    const std::ptrdiff_t o = from + i;
    const std::size_t n = to + static_cast<std::size_t>(i);
    const auto face = static_cast<std::size_t>(o);
    faces.flux[n] = static_cast<float>(throughflow_.component[d][face]);
    faces.open[n] = static_cast<float>(open.component[d][face]);
    faces.void_fraction[n] = static_cast<float>(
        void_fraction_in_face(grid_, void_fraction, d, d == 0 ? i : place[d], o));
  }
}

sdk::FaceColumns FaceTable::columns() const {
  return {faces_[0].flux,          faces_[1].flux,          faces_[2].flux,
          faces_[0].open,          faces_[1].open,          faces_[2].open,
          faces_[0].void_fraction, faces_[1].void_fraction, faces_[2].void_fraction};
}

}  // namespace dust::run

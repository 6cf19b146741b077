// SPDX-License-Identifier: Apache-2.0
#include "coupling/smooth_kernel.hpp"

#include "coupling/own_disturbance.hpp"

#include <algorithm>
#include <cmath>

namespace dust::coupling {
namespace {

/// Cubic B-spline of knots 1 apart, without its factor 1/6; 0 from 2 on.
double spline(double x) {
  const double far = 2.0 - std::abs(x);
  if (far <= 0.0) return 0.0;
  const double near = 1.0 - std::abs(x);
  return far * far * far - (near > 0.0 ? 4.0 * near * near * near : 0.0);
}

}  // namespace

/// Points along an axis around `place` (in cells from the first face), `knots` in cells; returns
/// whether all of them are inside the domain.
bool SmoothKernel::meet(int axis, double place, double knots, bool is_of_faces,
                        Points& points) const {
  const int n = lattice_.grid().count[static_cast<std::size_t>(axis)];
  const bool is_periodic = lattice_.grid().is_periodic[static_cast<std::size_t>(axis)];
  const double shift = is_of_faces ? 0.0 : 0.5;
  const double reach = 2.0 * knots;
  int first = static_cast<int>(std::ceil(place - shift - reach));
  int last = static_cast<int>(std::floor(place - shift + reach));
  bool is_inside = true;
  if (!is_periodic) {
    // Faces on the sides belong to the boundary.
    const int lowest = is_of_faces ? 1 : 0;
    is_inside = first >= lowest && last < n;
    first = std::clamp(first, lowest, n - 1);
    last = std::clamp(last, first, n - 1);
  } else {
    is_inside = reach + reach <= n;
  }
  last = std::min(last, first + static_cast<int>(k_room) - 1);
  points.first = first;
  points.count = static_cast<std::size_t>(last - first + 1);
  double sum = 0.0;
  for (std::size_t p = 0; p < points.count; ++p) {
    const int i = first + static_cast<int>(p);
    points.offset[p] = lattice_.offset_along(axis, i);
    points.weight[p] = spline((i + shift - place) / knots);
    sum += points.weight[p];
  }
  if (!(sum > 0.0)) {  // nothing inside: the nearest
    points.weight.fill(0.0);
    points.weight[0] = sum = 1.0;
  }
  for (std::size_t p = 0; p < points.count; ++p) points.weight[p] /= sum;
  return is_inside;
}

bool SmoothKernel::set(const double* position, double diameter) {
  const fluid::Grid& grid = lattice_.grid();
  bool is_inside = true;
  double volume = 1.0;
  for (int d = 0; d < 3; ++d) {
    const double h = grid.spacing[d];
    const double knots = std::max(diameter, own_disturbance::k_least_knots * h);
    const double place = (position[d] - grid.origin[d]) / h;
    const bool has_faces = meet(d, place, knots / h, true, faces_[static_cast<std::size_t>(d)]);
    const bool has_cells = meet(d, place, knots / h, false, middles_[static_cast<std::size_t>(d)]);
    is_inside = is_inside && has_faces && has_cells;
    volume *= own_disturbance::kernel_width(knots, h);
  }
  width_ = std::cbrt(volume);
  return is_inside && (!lattice_.has_bodies() || is_clear());
}

/// Whether no body cuts a face of the kernel.
bool SmoothKernel::is_clear() const {
  bool is_open = true;
  for (int d = 0; d < 3; ++d) {
    const float* open = lattice_.open_shares(d);
    for_faces(d, [&](std::ptrdiff_t home, double) { is_open = is_open && open[home] == 1.0F; });
  }
  return is_open;
}

double SmoothKernel::concentration(int d) const {
  double product = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Points& p = points(d, axis);
    double sum = 0.0;
    for (std::size_t n = 0; n < p.count; ++n) sum += p.weight[n] * p.weight[n];
    product *= sum;
  }
  return product;
}

double SmoothKernel::overlap(int d) const {
  double product = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Points& of_faces = points(d, axis);
    const Points& of_cells = points(k_cells, axis);
    double sum = 0.0;
    for (std::size_t n = 0; n < of_faces.count; ++n) {
      const int i = of_faces.first + static_cast<int>(n);
      const double beside = d == axis ? 0.5 * (of_cells.at(i - 1) + of_cells.at(i)) : of_cells.at(i);
      sum += of_faces.weight[n] * beside;
    }
    product *= sum;
  }
  return product;
}

double SmoothKernel::weight(int d, std::array<int, 3> face) const {
  double product = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    product *= points(d, axis).at(face[static_cast<std::size_t>(axis)]);
  }
  return product;
}

}  // namespace dust::coupling

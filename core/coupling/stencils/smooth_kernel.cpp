// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/smooth_kernel.hpp"

#include "coupling/self_disturbance/disturbance_formulas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::coupling {
namespace {

/// Cubic B-spline of knots 1 apart, without its factor 1/6; 0 from 2 on.
double spline(double x) {
  const double far = 2.0 - std::abs(x);
  if (far <= 0.0) return 0.0;
  const double near = 1.0 - std::abs(x);
  return far * far * far - (near > 0.0 ? 4.0 * near * near * near : 0.0);
}

/// Knots [cells] of a kernel that ends where the mirrored velocity does, two cells and a half
/// behind a wall at `distance` [cells].
double knots_beside(double distance) { return 0.5 * (distance + 2.5); }

}  // namespace

/// Points along an axis around `place` (in cells from the first face), `knots` in cells.
void SmoothKernel::meet(int axis, double place, double knots, bool is_of_faces,
                        Points& points) const {
  const double shift = is_of_faces ? 0.0 : 0.5;
  int first = static_cast<int>(std::ceil(place - shift - 2.0 * knots));
  int last = static_cast<int>(std::floor(place - shift + 2.0 * knots));
  if (!lattice_.grid().is_periodic[static_cast<std::size_t>(axis)]) {
    const int beyond = lattice_.grid().count[static_cast<std::size_t>(axis)] + 1;
    first = std::clamp(first, -2, beyond);
    last = std::clamp(last, first, beyond);
  }
  last = std::min(last, first + static_cast<int>(k_room) - 1);
  points.first = first;
  points.count = static_cast<std::size_t>(last - first + 1);
  const double per_knot = 1.0 / knots;
  double sum = 0.0;
  for (std::size_t p = 0; p < points.count; ++p) {
    const int i = first + static_cast<int>(p);
    points.offset[p] = lattice_.offset_along(axis, i);
    points.weight[p] = spline((i + shift - place) * per_knot);
    sum += points.weight[p];
  }
  if (!(sum > 0.0)) points.weight[0] = sum = 1.0;  // a grain far beyond a side
  const double inverse = 1.0 / sum;
  for (std::size_t p = 0; p < points.count; ++p) points.weight[p] *= inverse;
  points.lowest = first;
  points.highest = last;
  points.inside = 1.0;
  if (lattice_.grid().is_periodic[static_cast<std::size_t>(axis)]) return;
  points.lowest = std::max(first, is_of_faces ? 1 : 0);
  points.highest = std::min(last, lattice_.grid().count[static_cast<std::size_t>(axis)] - 1);
  points.inside = 0.0;
  for (int i = points.lowest; i <= points.highest; ++i) points.inside += weight_at(points, i);
}

SmoothKernel::Room SmoothKernel::set(const double* position, double diameter) {
  constexpr double k_any = std::numeric_limits<double>::infinity();
  is_cut_ = false;
  const Room room = meet_domain(position, diameter, {k_any, k_any, k_any});
  if (room == Room::none || !lattice_.has_bodies() || is_clear()) return room;
  const sdk::Vec3 place{position[0], position[1], position[2]};
  const fluid::Grid& grid = lattice_.grid();
  const double knots = std::max(diameter, self_disturbance::k_min_knots * grid.largest_spacing());
  const auto wall = lattice_.walls().nearest(place, 4.0 * knots);
  if (!wall) return Room::none;
  sdk::Vec3 most_knots;
  for (int d = 0; d < 3; ++d) {
    const double slope = std::max(std::abs(wall->normal[d]), 1e-3);
    most_knots[d] = knots_beside(std::max(wall->distance, 0.0) / (grid.spacing[d] * slope));
  }
  if (meet_domain(position, diameter, most_knots) == Room::none) return Room::none;
  is_cut_ = true;
  return is_beside_plane(place, *wall) ? Room::beside : Room::none;
}

/// The kernel with `most_knots` [cells] at most along each axis.
SmoothKernel::Room SmoothKernel::meet_domain(const double* position, double diameter,
                                             const sdk::Vec3& most_knots) {
  constexpr int k_min = 4;  // cells between sides: the flow around a grain is one in space
  const fluid::Grid& grid = lattice_.grid();
  Room room = Room::open;
  double volume = 1.0;
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    const double h = grid.spacing[d];
    const int n = grid.count[axis];
    double knots = std::max(diameter / h, self_disturbance::k_min_knots);
    double place = (position[d] - grid.origin[d]) / h;
    if (grid.is_periodic[axis]) {
      if (4.0 * knots > n) room = Room::none;
    } else {
      place = std::clamp(place, 0.0, static_cast<double>(n));
      const double side = std::min(place, n - place);
      // Two cells of the halo, and half a cell to the next point.
      if (2.0 * knots > side - 0.5 && room == Room::open) room = Room::beside;
      if (n < k_min) room = Room::none;
      knots = std::min(knots, knots_beside(side));
    }
    knots = std::min(knots, most_knots[d]);
    meet(d, place, knots, true, faces_[axis]);
    meet(d, place, knots, false, middles_[axis]);
    volume *= self_disturbance::kernel_width(knots * h, h);
  }
  width_ = std::cbrt(volume);
  return room;
}

/// Whether no body cuts a cell of the kernel.
bool SmoothKernel::is_clear() const {
  bool is_open = true;
  for_cells([&](std::ptrdiff_t cell, double) {
    is_open = is_open && lattice_.open_fraction(cell) == 1.0;
  });
  return is_open;
}

/// Whether the cells of the kernel are open and closed as a plane through the wall's point makes
/// them, to most of a cell: no edge, no second body, no sheet with fluid behind it.
bool SmoothKernel::is_beside_plane(sdk::Vec3 position, const NearWalls::Wall& wall) const {
  const fluid::Grid& grid = lattice_.grid();
  const double allowed = 0.9 * grid.largest_spacing();
  bool is_plane = true;
  for_indexed_cells([&](std::array<int, 3> index, std::ptrdiff_t cell) {
    const double open = lattice_.open_fraction(cell);
    const sdk::Vec3 from = grid.centre(index[0], index[1], index[2]) - position;
    const double height = wall.distance + dot(from, wall.normal);
    if (open == 1.0 && height < -allowed) is_plane = false;
    if (open == 0.0 && height > allowed) is_plane = false;
  });
  return is_plane;
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

double SmoothKernel::inside(int d) const {
  if (is_cut_) {
    double sum = 0.0;
    for_inside(d, [&](const std::array<int, 3>& at) { sum += weight(d, at); });
    return sum;
  }
  return points(d, 0).inside * points(d, 1).inside * points(d, 2).inside;
}

/// As overlap(), over what is outside bodies, place by place.
double SmoothKernel::overlap_of_cut(int d) const {
  double sum = 0.0;
  const auto solids = [&](const std::array<int, 3>& cell) {
    return room_in(accounted_at(cell)) > 0.0 ? plain_weight(k_cells, cell) : 0.0;
  };
  for_inside(d, [&](const std::array<int, 3>& face) {
    std::array<int, 3> below = face;
    below[static_cast<std::size_t>(d)] -= 1;
    sum += weight(d, face) * 0.5 * (solids(below) + solids(face));
  });
  const double whole = inside(d) * inside();
  return whole > 0.0 ? sum / whole : 0.0;
}

double SmoothKernel::overlap(int d) const {
  if (is_cut_) return overlap_of_cut(d);
  double product = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Points& of_faces = points(d, axis);
    const Points& of_cells = points(k_cells, axis);
    double sum = 0.0;
    for (int i = of_faces.lowest; i <= of_faces.highest; ++i) {
      const double beside = d == axis ? 0.5 * (weight_at(of_cells, i - 1) + weight_at(of_cells, i))
                                      : weight_at(of_cells, i);
      sum += weight_at(of_faces, i) * beside;
    }
    const double whole = of_faces.inside * of_cells.inside;
    product *= whole > 0.0 ? sum / whole : 0.0;
  }
  return product;
}

double SmoothKernel::weight(int d, std::array<int, 3> face) const {
  const double whole = plain_weight(d, face);
  if (!is_cut_ || whole == 0.0) return whole;
  return whole *
         (d == k_cells ? room_in(accounted_at(face)) : lattice_.open_share(d, accounted_at(face)));
}

double SmoothKernel::weight_at_storage(int d, std::ptrdiff_t storage) const {
  std::array<int, 3> at = lattice_.indices(storage);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!lattice_.grid().is_periodic[axis]) continue;
    const int first = points(d, static_cast<int>(axis)).first;
    const int n = lattice_.grid().count[axis];
    at[axis] = first + (((at[axis] - first) % n) + n) % n;  // the image that the kernel may meet
  }
  return weight(d, at);
}

double SmoothKernel::plain_weight(int d, std::array<int, 3> face) const {
  double product = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    product *= weight_at(points(d, axis), face[static_cast<std::size_t>(axis)]);
  }
  return product;
}

}  // namespace dust::coupling

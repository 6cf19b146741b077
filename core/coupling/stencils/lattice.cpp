// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/lattice.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace dust::coupling {
namespace {

/// Open share of a face's control volume up to which the face takes nothing: its centre then lies
/// in or on a body, where the fluid's velocity is given and a force would be lost.
constexpr double k_closed_face = 0.5 + 1e-9;
/// A point this close to a surface [cells] counts as being on it, as for the fluid.
constexpr double k_on_surface = 1e-6;

int wrap(int i, int n) { return ((i % n) + n) % n; }

}  // namespace

Lattice::Lattice(const fluid::Grid& grid, const fluid::CellField& open_fraction)
    : grid_(grid), cell_volume_(grid.cell_volume()) {
  for (int d = 0; d < 3; ++d) {
    inverse_spacing_[d] = 1.0 / grid.spacing[d];
    const int n = grid.count[d];
    const int pad = d == 0 ? fluid::Grid::k_margin : fluid::Grid::k_halo;
    for (int i = -2; i <= n + 1; ++i) {
      const int inside = grid.is_periodic[d] ? wrap(i, n) : std::clamp(i, 0, n - 1);
      cells_[d].push_back((inside + pad) * grid.stride[d]);
      padded_[d].push_back((i + pad) * grid.stride[d]);
      storage_[d].push_back(((grid.is_periodic[d] ? wrap(i, n) : i) + pad) * grid.stride[d]);
    }
  }
  for (std::size_t d = 0; d < 3; ++d) {
    short_storage_[d].assign(storage_[d].begin(), storage_[d].end());
    axes_[d] = {grid.origin[static_cast<int>(d)], inverse_spacing_[static_cast<int>(d)],
                grid.count[d], grid.is_periodic[d], short_storage_[d].data()};
  }
  set_open_fraction(open_fraction);
}

void Lattice::set_open_fraction(const fluid::CellField& open_fraction) {
  open_cell_ = open_fraction;
  has_bodies_ = false;
  for (auto& faces : blocked_) faces.clear();
  for (int k = 0; k < grid_.count[2]; ++k) {
    for (int j = 0; j < grid_.count[1]; ++j) {
      for (int i = 0; i < grid_.count[0]; ++i) {
        has_bodies_ = has_bodies_ || open_cell_[grid_.index(i, j, k)] != 1.0;
      }
    }
  }
  for (int d = 0; d < 3; ++d) open_faces(d);
}

void Lattice::open_faces(int d) {
  open_face_[d].assign(grid_.size, 0.0F);
  for (int k = 0; k < grid_.count[2]; ++k) {
    for (int j = 0; j < grid_.count[1]; ++j) {
      for (int i = 0; i < grid_.count[0]; ++i) {
        const std::array<int, 3> at{i, j, k};
        // A face on a side belongs to the boundary; the next one inside takes its part.
        if (at[d] == 0 && !grid_.is_periodic[d]) continue;
        const double upper = open_cell_[grid_.index(i, j, k)];
        const double lower = open_cell_[cell(i - (d == 0), j - (d == 1), k - (d == 2))];
        const double share = 0.5 * (lower + upper);
        if (!(share > k_closed_face)) continue;
        if (share < 1.0 && is_in_body(grid_.face(d, i, j, k))) continue;
        open_face_[d][grid_.index(i, j, k)] = static_cast<float>(share);
      }
    }
  }
}

/// A body's corner, or a bend, may reach over the middle of a face that is open for the greater
/// part: the fluid's velocity is given there, too.
bool Lattice::is_in_body(sdk::Vec3 face) const {
  const sdk::Vec3 spacing = grid_.spacing;
  const auto wall = walls_.nearest(face, std::max({spacing.x, spacing.y, spacing.z}));
  return wall && wall->distance <= k_on_surface * std::min({spacing.x, spacing.y, spacing.z});
}

void Lattice::use_walls(std::vector<particles::Surface> surfaces) {
  walls_.use(std::move(surfaces));
  if (has_bodies_) {
    for (int d = 0; d < 3; ++d) open_faces(d);
  }
}

void Lattice::close(std::span<const fluid::BlockedFace> faces) {
  for (auto& blocked : blocked_) blocked.clear();
  for (const fluid::BlockedFace& face : faces) {
    open_face_[static_cast<std::size_t>(face.axis)][static_cast<std::size_t>(face.at)] = 0.0F;
    blocked_[static_cast<std::size_t>(face.axis)].push_back(face.at);
  }
  for (auto& blocked : blocked_) std::sort(blocked.begin(), blocked.end());
}

bool Lattice::is_blocked(std::size_t d, std::ptrdiff_t face) const {
  return std::binary_search(blocked_[d].begin(), blocked_[d].end(), face);
}

std::ptrdiff_t Lattice::open_image(int i, int j, int k) const {
  const std::array<int, 3> at{i, j, k};
  for (int d = 0; d < 3; ++d) {
    const bool is_inside = at[d] >= 0 && at[d] < grid_.count[d];
    if (!is_inside && !grid_.is_periodic[d]) return -1;
  }
  const std::ptrdiff_t c =
      grid_.index(wrap(i, grid_.count[0]), wrap(j, grid_.count[1]), wrap(k, grid_.count[2]));
  return open_cell_[c] >= k_min_open ? c : -1;
}

std::ptrdiff_t Lattice::nearest_open_cell(const double* position) const {
  constexpr int k_reach = 2;
  const Place p = place(position);
  std::ptrdiff_t best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (int c = -k_reach; c <= k_reach; ++c) {
    for (int b = -k_reach; b <= k_reach; ++b) {
      for (int a = -k_reach; a <= k_reach; ++a) {
        const std::ptrdiff_t candidate = open_cell(p[0].cell + a, p[1].cell + b, p[2].cell + c);
        if (candidate < 0) continue;
        const double x = (a + 0.5 - p[0].face_part) * grid_.spacing.x;
        const double y = (b + 0.5 - p[1].face_part) * grid_.spacing.y;
        const double z = (c + 0.5 - p[2].face_part) * grid_.spacing.z;
        const double distance = x * x + y * y + z * z;
        if (distance < best_distance) {
          best_distance = distance;
          best = candidate;
        }
      }
    }
  }
  return best;
}

std::array<int, 3> Lattice::indices(std::ptrdiff_t cell) const {
  // The longer stride first: which one it is depends on the grid.
  std::ptrdiff_t j = 0;
  std::ptrdiff_t k = 0;
  std::ptrdiff_t i = cell;
  if (grid_.stride[2] > grid_.stride[1]) {
    k = i / grid_.stride[2];
    i -= k * grid_.stride[2];
    j = i / grid_.stride[1];
    i -= j * grid_.stride[1];
  } else {
    j = i / grid_.stride[1];
    i -= j * grid_.stride[1];
    k = i / grid_.stride[2];
    i -= k * grid_.stride[2];
  }
  return {static_cast<int>(i) - fluid::Grid::k_margin, static_cast<int>(j) - fluid::Grid::k_halo,
          static_cast<int>(k) - fluid::Grid::k_halo};
}

std::array<std::ptrdiff_t, 6> Lattice::open_neighbours(std::ptrdiff_t cell) const {
  const auto [i, j, k] = indices(cell);
  std::array<std::ptrdiff_t, 6> open{open_cell(i - 1, j, k), open_cell(i + 1, j, k),
                                     open_cell(i, j - 1, k), open_cell(i, j + 1, k),
                                     open_cell(i, j, k - 1), open_cell(i, j, k + 1)};
  // A face has the index of the cell above it.
  for (std::size_t d = 0; d < 3; ++d) {
    if (blocked_[d].empty()) continue;
    if (is_blocked(d, cell)) open[2 * d] = -1;
    if (is_blocked(d, storage(i + (d == 0), j + (d == 1), k + (d == 2)))) open[2 * d + 1] = -1;
  }
  return open;
}

void Lattice::close_periodic(int d, std::vector<double>& field) const {
  if (!grid_.is_periodic[d]) return;
  const int e = (d + 1) % 3;
  const int f = (d + 2) % 3;
  for (int j = 0; j < grid_.count[f]; ++j) {
    for (int i = 0; i < grid_.count[e]; ++i) {
      const std::ptrdiff_t column = offset(padded_[e], i) + offset(padded_[f], j);
      field[offset(padded_[d], grid_.count[d]) + column] = field[offset(padded_[d], 0) + column];
    }
  }
}

}  // namespace dust::coupling

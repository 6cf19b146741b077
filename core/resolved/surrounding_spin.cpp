// SPDX-License-Identifier: Apache-2.0
#include "resolved/surrounding_spin.hpp"

#include "resolved/face_stencil.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::resolved {
namespace {

using sdk::Vec3;

/// Cells from the surface to the shell: the delta function of a marker ends before it.
constexpr double k_away = 2.0;

/// What a marker at `place` would see.
Vec3 seen(const fluid::Grid& grid, const fluid::FaceField& velocity, Vec3 place) {
  Vec3 u;
  for (int d = 0; d < 3; ++d) {
    u[d] = FacePlaces(grid, d).mean(stencil_at(grid, d, place),
                                    velocity.component[static_cast<std::size_t>(d)].data());
  }
  return u;
}

}  // namespace

Vec3 surrounding_spin(const fluid::Grid& grid, const fluid::FaceField& velocity,
                      const MarkerLattice& markers, const Sphere& sphere) {
  const double spacing = std::cbrt(grid.cell_volume());
  const double distance = sphere.radius + k_away * spacing;
  Vec3 circulation;
  int pairs = 0;
  for (const Vec3& n : markers.direction) {
    const Vec3 away = distance * n;
    if (!is_in_domain(grid, sphere.position + away) ||
        !is_in_domain(grid, sphere.position - away)) {
      continue;
    }
    // The difference across the sphere knows nothing of how it moves along.
    const Vec3 across =
        seen(grid, velocity, sphere.position + away) - seen(grid, velocity, sphere.position - away);
    circulation += cross(n, across);
    ++pairs;
  }
  if (pairs == 0) return {};
  // Of a shell that turns as a whole: n x (Omega x n) has the mean 2/3 Omega.
  const Vec3 there = (0.75 / (distance * pairs)) * circulation;
  const double own = std::pow(sphere.radius / distance, 3);
  return (1.0 / (1.0 - own)) * (there - own * sphere.rotation);
}

}  // namespace dust::resolved

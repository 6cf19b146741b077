// SPDX-License-Identifier: Apache-2.0
#include "resolved/inner_fluid.hpp"

#include "dust/sdk/sphere.hpp"
#include "resolved/face_stencil.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace dust::resolved {
namespace {

using sdk::Vec3;

/// Share of a box around `from_centre` that lies in the sphere, from the distances of its corners
/// from the surface.
double share_inside(Vec3 from_centre, Vec3 size, double radius) {
  const double reach = 0.5 * norm(size);
  const double distance = norm(from_centre);
  if (distance <= radius - reach) return 1.0;
  if (distance >= radius + reach) return 0.0;
  double inside = 0.0;
  double all = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at{from_centre.x + (((corner & 1) != 0) ? 0.5 : -0.5) * size.x,
                  from_centre.y + (((corner & 2) != 0) ? 0.5 : -0.5) * size.y,
                  from_centre.z + (((corner & 4) != 0) ? 0.5 : -0.5) * size.z};
    const double depth = radius - norm(at);
    inside += std::max(0.0, depth);
    all += std::abs(depth);
  }
  return inside / all;
}

/// Of one component of the velocity: its sum over the sphere, and that of its moments.
struct Moments {
  double share = 0.0;  ///< [-] sum of the shares
  double velocity = 0.0;
  Vec3 arm;  ///< velocity times the way from the centre

  void add(double part, double u, Vec3 from_centre) {
    share += part;
    velocity += part * u;
    arm += part * u * from_centre;
  }
};

Moments moments_of(const fluid::Grid& grid, const std::vector<double>& u, int d,
                   const Sphere& sphere, Vec3 centre) {
  std::array<int, 3> low{};
  std::array<int, 3> high{};
  for (int e = 0; e < 3; ++e) {
    const auto n = static_cast<std::size_t>(e);
    const double reach = sphere.radius + grid.spacing[e];
    low[n] = static_cast<int>(std::floor(face_place(grid, d, e, centre[e] - reach)));
    high[n] = static_cast<int>(std::ceil(face_place(grid, d, e, centre[e] + reach)));
  }
  const FacePlaces places(grid, d);
  const std::ptrdiff_t origin = grid.index(0, 0, 0);
  Moments sum;
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      const std::ptrdiff_t row = origin + places.along(1, j) + places.along(2, k);
      for (int i = low[0]; i <= high[0]; ++i) {
        const Vec3 from_centre = grid.face(d, i, j, k) - centre;
        const double part = share_inside(from_centre, grid.spacing, sphere.radius);
        if (part == 0.0) continue;
        sum.add(part, u[static_cast<std::size_t>(row + places.along(0, i))], from_centre);
      }
    }
  }
  return sum;
}

}  // namespace

/// Of the volume itself, whatever the shares sum up to: so a sphere that moves along a uniform flow
/// has the same momentum wherever it stands in its cells.
Impulse inner_momentum(const fluid::Grid& grid, const fluid::FaceField& velocity, double density,
                       const Sphere& sphere, Vec3 centre) {
  const double mass = density * sdk::sphere_volume(2.0 * sphere.radius);
  Impulse inner;
  for (int d = 0; d < 3; ++d) {
    const Moments m =
        moments_of(grid, velocity.component[static_cast<std::size_t>(d)], d, sphere, centre);
    const double per_share = mass / m.share;
    inner.linear[d] = per_share * m.velocity;
    Vec3 along;
    along[d] = 1.0;
    inner.angular += per_share * cross(m.arm, along);
  }
  return inner;
}

}  // namespace dust::resolved

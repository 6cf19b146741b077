// SPDX-License-Identifier: Apache-2.0
#include "run/dust/wall_shear.hpp"

#include "airborne/near_wall.hpp"

#include <algorithm>
#include <cmath>

namespace dust::run {

void WallShear::add_side(const std::array<int, 3>& cell, int direction, double normal) {
  sdk::Vec3 n;
  n[direction] = normal;
  probes_.push_back({.point = grid_.centre(cell[0], cell[1], cell[2]),
                     .normal = n,
                     .distance = 0.5 * grid_.spacing[direction],
                     .is_body = false});
}

void WallShear::add_body(sdk::Vec3 centre, const fluid::BodyField::Hit& hit) {
  const sdk::Vec3 surface = centre - hit.distance * hit.normal;
  double width = 0.0;
  for (int d = 0; d < 3; ++d) width += std::abs(hit.normal[d]) * grid_.spacing[d];
  probes_.push_back({.point = surface + width * hit.normal,
                     .normal = hit.normal,
                     .distance = width,
                     .is_body = true});
}

sdk::Vec3 WallShear::velocity_at(const fluid::FaceField& velocity, sdk::Vec3 point) const {
  sdk::Vec3 found;
  for (int d = 0; d < 3; ++d) {
    std::array<int, 3> low{};
    std::array<double, 3> share{};
    for (int e = 0; e < 3; ++e) {
      const auto n = static_cast<std::size_t>(e);
      const double x = (point[e] - grid_.origin[e]) / grid_.spacing[e] - (e == d ? 0.0 : 0.5);
      // The halo's first row is the last that holds an extension of the flow.
      low[n] = std::clamp(static_cast<int>(std::floor(x)), -1, grid_.count[n] - 1);
      share[n] = std::clamp(x - low[n], 0.0, 1.0);
    }
    const std::vector<double>& u = velocity.component[static_cast<std::size_t>(d)];
    const std::ptrdiff_t first = grid_.index(low[0], low[1], low[2]);
    for (int corner = 0; corner < 8; ++corner) {
      std::ptrdiff_t at = first;
      double weight = 1.0;
      for (std::size_t e = 0; e < 3; ++e) {
        const bool is_high = ((corner >> e) & 1) != 0;
        if (is_high) at += grid_.stride[e];
        weight *= is_high ? share[e] : 1.0 - share[e];
      }
      if (weight > 0.0) found[d] += weight * u[static_cast<std::size_t>(at)];
    }
  }
  return found;
}

void WallShear::find(const fluid::FaceField& velocity,
                     const std::vector<airborne::SurfaceMotion>& surfaces,
                     std::vector<double>& friction_velocity) const {
  friction_velocity.resize(probes_.size());
  for (std::size_t n = 0; n < probes_.size(); ++n) {
    const Probe& probe = probes_[n];
    sdk::Vec3 wall;
    if (!probe.is_body) {
      wall = velocity_at(velocity, probe.point - probe.distance * probe.normal);
    } else if (!surfaces.empty()) {
      wall = surfaces[n].velocity;
    }
    const sdk::Vec3 slip = velocity_at(velocity, probe.point) - wall;
    const sdk::Vec3 along = slip - dot(slip, probe.normal) * probe.normal;
    friction_velocity[n] = airborne::friction_velocity(norm(along), probe.distance, viscosity_);
  }
}

}  // namespace dust::run

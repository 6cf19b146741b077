// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/suction_cover.hpp"

#include "fluid/grid.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dust::preflight {
namespace {

using bodies::Body;
using scenario::Setup;
using sdk::Vec3;

/// Points per direction at which an opening is looked at.
constexpr int k_points = 12;
/// Of a cell: how far before the opening the fluid would begin.
constexpr double k_before = 1e-3;

bool is_within(Vec3 p, Vec3 low, Vec3 high, double rounding) {
  for (int d = 0; d < 3; ++d) {
    if (p[d] < low[d] - rounding || p[d] > high[d] + rounding) return false;
  }
  return true;
}

/// Places just before the opening of a body, in the domain.
std::vector<Vec3> places_before(const Setup& setup, const Body& body, double distance) {
  const Vec3 low = body.suction->min;
  const Vec3 edges = body.suction->max - low;
  const bodies::Placement at = body.placement(0.0);
  std::vector<Vec3> places;
  for (int n = 0; n < k_points * k_points * k_points; ++n) {
    const Vec3 share{(n % k_points + 0.5) / k_points, (n / k_points % k_points + 0.5) / k_points,
                     (n / (k_points * k_points) + 0.5) / k_points};
    const Vec3 sample = low + Vec3{share.x * edges.x, share.y * edges.y, share.z * edges.z};
    const bodies::SurfacePoint s = body.shape->nearest(sample);
    const Vec3 foot = sample - s.distance * s.normal;
    if (!is_within(foot, low, body.suction->max, distance)) continue;
    const Vec3 place = at.to_domain(foot + distance * s.normal);
    if (is_within(place, setup.domain.min, setup.domain.max, 0.0)) places.push_back(place);
  }
  return places;
}

/// The body that all places are in, or the last of several; nothing where one is free.
std::optional<std::size_t> cover_of(const ParticleModels& models, std::size_t hood,
                                    const std::vector<Vec3>& places) {
  std::optional<std::size_t> cover;
  for (const Vec3& place : places) {
    const auto found =
        std::find_if(models.bodies.begin(), models.bodies.end(), [&](const Body& other) {
          return &other != &models.bodies[hood] && other.shape->is_solid() &&
                 other.nearest(place).distance < 0.0;
        });
    if (found == models.bodies.end()) return std::nullopt;
    cover = static_cast<std::size_t>(found - models.bodies.begin());
  }
  return cover;
}

bool stays(const Setup& setup, const ParticleModels& models, std::size_t body) {
  return !models.bodies[body].is_carried() && !setup.bodies[body].removal;
}

}  // namespace

void check_suction_covers(const Setup& setup, const ParticleModels& models,
                          scenario::Diagnostics& diagnostics) {
  if (!setup.fluid) return;
  const Vec3 h =
      fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, {}).spacing;
  const double before = k_before * std::min({h.x, h.y, h.z});
  for (std::size_t n = 0; n < setup.bodies.size(); ++n) {
    const auto& suction = setup.bodies[n].suction;
    if (!suction || !models.bodies[n].shape->is_solid() || !stays(setup, models, n)) continue;
    const auto cover = cover_of(models, n, places_before(setup, models.bodies[n], before));
    if (!cover || !stays(setup, models, *cover)) continue;
    diagnostics.error(suction->where, "bodies." + setup.bodies[n].name + ".suction: '" +
                                          setup.bodies[*cover].name +
                                          "' covers the opening, so that it meets no fluid: move "
                                          "that body, or the opening (min, max) to where the "
                                          "surface is free");
  }
}

}  // namespace dust::preflight

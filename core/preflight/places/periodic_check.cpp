// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/periodic_check.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace dust::preflight {
namespace {

using sdk::Vec3;

constexpr const char* k_axes[3] = {"x", "y", "z"};

bool is_periodic(const scenario::Setup& setup, int d) {
  return setup.domain.sides[static_cast<std::size_t>(2 * d)].grains ==
         scenario::GrainSide::periodic;
}

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

/// Of a body along d, as far as a box far beyond the domain.
Extent extent_of(const scenario::DomainSpec& domain, const bodies::Body& body, int d,
                 double diameter) {
  const double far = 2.0 * (norm(domain.max - domain.min) + diameter);
  const Vec3 more{far, far, far};
  Extent extent;
  for (const Vec3& p :
       body.triangles(domain.min - more, domain.max + more, far, body.placement(0.0))) {
    extent.low = std::min(extent.low, p[d]);
    extent.high = std::max(extent.high, p[d]);
  }
  return extent;
}

/// Grains are put back when they are a radius beyond a periodic side: a body has to be there as
/// far, or so far away that none of them would touch its other end.
bool is_whole(const Extent& body, double low, double high, double diameter) {
  const double rounding = 1e-9 * (high - low);
  const double radius = 0.5 * diameter - rounding;
  diameter -= rounding;
  const bool spans = body.low <= low - radius && body.high >= high + radius;
  const bool lies_inside = body.low >= low + diameter && body.high <= high - diameter;
  const bool lies_outside = body.low >= high + diameter || body.high <= low - diameter;
  return spans || lies_inside || lies_outside;
}

void check_body(const scenario::Setup& setup, std::size_t b, const bodies::Body& body, int d,
                double diameter, scenario::Diagnostics& diagnostics) {
  const double low = setup.domain.min[d];
  const double high = setup.domain.max[d];
  const Extent extent = extent_of(setup.domain, body, d, diameter);
  if (is_whole(extent, low, high, diameter)) return;
  const auto text = [](double length) { return base::length_text(length); };
  const auto side = static_cast<std::size_t>(2 * d);
  diagnostics.error(
      setup.bodies[b].where,
      "bodies." + body.name + ": ends near the periodic sides " + scenario::k_side_names[side] +
          " and " + scenario::k_side_names[side + 1] + " (" + k_axes[d] + " from " +
          text(extent.low) + " to " + text(extent.high) +
          "), where grains that pass through would miss it: let it reach beyond both, from " +
          text(low - diameter) + " to " + text(high + diameter) + ", or keep it between " +
          text(low + diameter) + " and " + text(high - diameter));
}

}  // namespace

void check_bodies_at_periodic_sides(const scenario::Setup& setup, const ParticleModels& models,
                                    scenario::Diagnostics& diagnostics) {
  if (!is_periodic(setup, 0) && !is_periodic(setup, 1) && !is_periodic(setup, 2)) return;
  if (models.class_diameters.empty()) return;
  for (int d = 0; d < 3; ++d) {
    if (!is_periodic(setup, d)) continue;
    for (std::size_t b = 0; b < models.bodies.size(); ++b) {
      check_body(setup, b, models.bodies[b], d, models.class_diameters.back(), diagnostics);
    }
  }
}

}  // namespace dust::preflight

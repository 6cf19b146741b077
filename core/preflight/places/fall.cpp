// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/fall.hpp"

#include "preflight/emissions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::preflight {
namespace {

using scenario::DomainSpec;
using scenario::EmitterSpec;
using scenario::GrainSide;
using scenario::Setup;
using sdk::Vec3;

/// [kg/m3] Denser fluids are liquids.
constexpr double k_liquid = 100.0;

/// Grains of a stream that tell where it comes in.
constexpr std::size_t k_looked_at = 100;

/// [m] The corner of the domain that lies farthest along `way`.
double far_corner(const DomainSpec& domain, Vec3 way) {
  double far = 0.0;
  for (int d = 0; d < 3; ++d) far += std::max(domain.min[d] * way[d], domain.max[d] * way[d]);
  return far;
}

/// [m] along `down`: the lowest corner of a body's surface that faces upwards inside the domain.
double lowest_of(const bodies::Body& body, const DomainSpec& domain, Vec3 down) {
  constexpr double k_upwards = 0.1;  // of the normal: 6 degrees from a plumb wall
  // Curved parts need not be fine to tell how low they reach.
  const double edge = 10.0 * bodies::written_edge(domain.min, domain.max);
  const bodies::Placement at = body.placement(0.0);
  const bodies::Triangles corners = body.triangles(domain.min, domain.max, edge, at);
  double lowest = -std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
    double low = -std::numeric_limits<double>::infinity();
    for (std::size_t n = c; n < c + 3; ++n) low = std::max(low, dot(corners[n], down));
    if (!(low > lowest)) continue;
    // Above it, so that a sheet is seen from there; inside of a body that faces down.
    const Vec3 middle = (corners[c] + corners[c + 1] + corners[c + 2]) / 3.0 - 1e-6 * edge * down;
    if (dot(body.nearest(middle, at).normal, down) < -k_upwards) lowest = low;
  }
  return lowest;
}

/// [m] along `down`: how low grains may be stopped; minus infinity where nothing does.
double lowest_stop(const Setup& setup, const bodies::BodySet& bodies, Vec3 down) {
  const DomainSpec& domain = setup.domain;
  const double bottom = far_corner(domain, down);
  for (int d = 0; d < 3; ++d) {
    if (down[d] == 0.0) continue;
    const auto side = static_cast<std::size_t>(2 * d + (down[d] > 0.0 ? 1 : 0));
    if (domain.sides[side].grains != GrainSide::open) return bottom;
  }
  double lowest = -std::numeric_limits<double>::infinity();
  for (const bodies::Body& body : bodies) lowest = std::max(lowest, lowest_of(body, domain, down));
  return std::min(lowest, bottom);
}

/// [m] along `down`: the highest place at which grains come in.
double entry(const Setup& setup, const EmitterSpec& spec, sdk::Emitter& emitter, Vec3 down) {
  const double top = -far_corner(setup.domain, -1.0 * down);
  if (!emitter.insertion_rule().waits || brings_too_many(setup, spec, emitter)) return top;
  double highest = std::numeric_limits<double>::infinity();
  for (const sdk::InsertionRequest& grain : proposals(setup, spec, emitter, k_looked_at)) {
    highest = std::min(highest, dot(grain.position, down));
  }
  return std::isfinite(highest) ? std::max(highest, top) : top;
}

/// The same with the fluid's drag where it is not small.
double speed_in_fluid(const Setup& setup, const EmitterSpec& spec, const sdk::Emitter& emitter,
                      double speed) {
  if (!setup.fluid) return speed;
  if (!setup.fluid->resolves(spec.material) && setup.fluid->density < k_liquid) return speed;
  const auto diameters = emitter.diameters();
  if (diameters.empty()) return speed;
  const double density =
      setup.materials[static_cast<std::size_t>(spec.material)].properties.density;
  const double largest = *std::max_element(diameters.begin(), diameters.end());
  return std::min(speed,
                  std::max(emitter.largest_speed(), settling_speed(setup, largest, density)));
}

}  // namespace

double settling_speed(const Setup& setup, double diameter, double density) {
  constexpr int k_rounds = 60;
  const scenario::FluidSpec& fluid = *setup.fluid;
  const double pull =
      4.0 / 3.0 * diameter * norm(setup.gravity) * std::abs(density / fluid.density - 1.0);
  double speed = std::sqrt(pull);
  for (int n = 0; n < k_rounds && speed > 0.0; ++n) {
    const double re = fluid.density * speed * diameter / fluid.viscosity;
    const double drag = re < 1000.0 ? 24.0 / re * (1.0 + 0.15 * std::pow(re, 0.687)) : 0.44;
    speed = std::sqrt(speed * std::sqrt(pull / drag));
  }
  return speed;
}

Fall largest_fall(const Setup& setup, const bodies::BodySet& bodies,
                  const registry::Registry& registry) {
  const double g = norm(setup.gravity);
  if (!(g > 0.0) || setup.emitters.empty()) return {};
  const Vec3 down = setup.gravity / g;
  const double stop = lowest_stop(setup, bodies, down);
  Fall fall;
  for (const EmitterSpec& spec : setup.emitters) {
    // A fresh one: what it proposes is counted by others, too.
    const auto emitter = registry.create_as<sdk::Emitter>(spec.model);
    const double height = stop - entry(setup, spec, *emitter, down);
    if (!(height > 0.0)) continue;
    const double speed = speed_in_fluid(
        setup, spec, *emitter, std::hypot(emitter->largest_speed(), std::sqrt(2.0 * g * height)));
    if (speed > fall.speed) fall = {height, speed};
  }
  return fall;
}

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/belt_check.hpp"

#include "base/text.hpp"
#include "preflight/places/shape_parameter.hpp"

#include <cstddef>
#include <string>

namespace dust::preflight {
namespace {

using sdk::Vec3;

/// Diameters from which a grain that comes in is right above a belt.
constexpr double k_right_above = 20.0;
/// [-] Cosine of what comes in against a belt's way.
constexpr double k_against = 0.5;
/// [-] Of a velocity: a smaller level part is none.
constexpr double k_level = 1e-6;

/// [m/s] of the belt's top towards its head at the end of the run.
double speed_to_head(const scenario::Setup& setup, const bodies::Body& body, Vec3 head, Vec3 tail) {
  const Vec3 along = (head - tail) / norm(head - tail);
  const double length = norm(head - tail);
  const bodies::Placement at = body.placement(setup.time.end);
  const Vec3 middle = at.to_domain(0.5 * (head + tail));
  const Vec3 up = -setup.gravity / norm(setup.gravity);
  const bodies::SurfacePoint top = body.nearest(middle + length * up, at);
  const Vec3 foot = middle + (length - top.distance) * up;
  return dot(body.surface_velocity(foot, up, setup.time.end), at.turn(along));
}

}  // namespace

void check_belts(const scenario::Setup& setup, const ParticleModels& models,
                 scenario::Diagnostics& diagnostics) {
  if (!(norm(setup.gravity) > 0.0)) return;
  for (std::size_t n = 0; n < setup.bodies.size(); ++n) {
    const scenario::BodySpec& spec = setup.bodies[n];
    if (spec.motions.size() != 1 || models.bodies[n].displaces()) continue;
    const Vec3* head = shape_parameter<Vec3>(spec.shape, "head");
    const Vec3* tail = shape_parameter<Vec3>(spec.shape, "tail");
    if (head == nullptr || tail == nullptr) continue;
    const Vec3* up = shape_parameter<Vec3>(spec.shape, "up");
    if (up != nullptr &&
        dot(models.bodies[n].placement(setup.time.end).turn(*up), setup.gravity) > 0.0) {
      // Told once: with it every belt seems to run backwards.
      diagnostics.warning(
          spec.shape.where,
          "bodies." + spec.name +
              ": gravity points out of the belt's carrying side: is its sign right?");
      return;
    }
    const double speed = speed_to_head(setup, models.bodies[n], *head, *tail);
    if (!(speed < 0.0)) continue;
    diagnostics.warning(spec.motions.front().where,
                        "bodies." + spec.name + ": the top of the belt runs at " +
                            base::digits_text(-speed, 3) +
                            " m/s away from its head pulley; give a speed of the other sign, or "
                            "head and tail in each other's place, unless it shall run backwards");
  }
}

void check_feeds_on_belts(const scenario::Setup& setup, const ParticleModels& models,
                          std::span<const std::vector<sdk::InsertionRequest>> first,
                          scenario::Diagnostics& diagnostics) {
  if (!(norm(setup.gravity) > 0.0)) return;
  // What falls onto a slope goes against its way in part: the level parts count.
  const Vec3 down = setup.gravity / norm(setup.gravity);
  const auto level = [&](Vec3 v) { return v - dot(v, down) * down; };
  for (std::size_t e = 0; e < setup.emitters.size(); ++e) {
    if (first[e].empty() || !models.emitters[e]->insertion_rule().waits) continue;
    const sdk::InsertionRequest& grain = first[e].front();
    for (std::size_t n = 0; n < setup.bodies.size(); ++n) {
      const bodies::Body& body = models.bodies[n];
      const bool is_belt = shape_parameter<Vec3>(setup.bodies[n].shape, "head") != nullptr;
      if (!is_belt || body.motions.size() != 1 || body.displaces()) continue;
      const bodies::SurfacePoint below = body.nearest(grain.position);
      if (!(below.distance < k_right_above * grain.diameter)) continue;
      const Vec3 foot = grain.position - below.distance * below.normal;
      const Vec3 belt = level(body.surface_velocity(foot, below.normal, setup.time.end));
      const Vec3 along = level(grain.velocity);
      const bool is_level = norm(along) > k_level * norm(grain.velocity);
      if (!is_level || !(dot(along, belt) < -k_against * norm(along) * norm(belt))) continue;
      const scenario::EmitterSpec& spec = setup.emitters[e];
      diagnostics.warning(spec.model.where,
                          spec.model.path + ": its grains come in at " +
                              base::digits_text(norm(along), 3) + " m/s against the way of '" +
                              body.name + "' below them, which runs at " +
                              base::digits_text(norm(belt), 3) +
                              " m/s; turn the velocity of the one or the other round, or put head "
                              "and tail of the belt in each other's place");
    }
  }
}

}  // namespace dust::preflight

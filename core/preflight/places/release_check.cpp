// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/release_check.hpp"

#include "base/text.hpp"
#include "preflight/journey.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dust::preflight {
namespace {

using sdk::Vec3;

/// Grains that are looked at.
constexpr std::size_t k_sample = 200;
/// [-] of the radius: a grain let in deeper in something is thrown out of it.
constexpr double k_deep = 0.1;

/// Grains that come in where they should not.
struct Misplaced {
  std::string what;  ///< the body or side
  std::size_t count = 0;
  Vec3 first;  ///< [m]
  void note(const std::string& name, Vec3 place) {
    if (count++ > 0) return;
    what = name;
    first = place;
  }
};

/// Where the run lets a grain in: at the beginning of a fluid step, carried back along its way.
Vec3 release_of(const scenario::Setup& setup, const sdk::InsertionRequest& grain) {
  const double step = setup.time.fluid_step;
  const double since = grain.time - step * std::floor(grain.time / step);
  return grain.position - since * grain.velocity;
}

/// Notes a grain that is beyond a side, or in one that is a wall.
void look_at_sides(const scenario::Setup& setup, const scenario::DustSetup& dust, Vec3 place,
                   double radius, Misplaced& outside, Misplaced& stuck) {
  for (std::size_t side = 0; side < 6; ++side) {
    const int d = static_cast<int>(side) / 2;
    const auto kind = setup.domain.sides[side].grains;
    const bool is_opened =
        std::any_of(dust.openings.begin(), dust.openings.end(),
                    [&](const auto& o) { return static_cast<std::size_t>(o.side) == side; });
    if (is_opened) continue;
    const double room =
        side % 2 == 0 ? place[d] - setup.domain.min[d] : setup.domain.max[d] - place[d];
    const std::string name = std::string("the side '") + scenario::k_side_names[side] + "'";
    if (kind == scenario::GrainSide::wall && room < (1.0 - k_deep) * radius) {
      stuck.note(name, place);
      return;
    }
    if (kind == scenario::GrainSide::open && room < 0.0) {
      outside.note(name, place);
      return;
    }
  }
}

void look_at_bodies(const scenario::Setup& setup, const bodies::BodySet& bodies, Vec3 place,
                    double radius, double time, Misplaced& stuck) {
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const bodies::Body& body = bodies[n];
    if (body.suction || may_be_gone(setup.bodies[n], time, setup.time.fluid_step)) continue;
    if (body.nearest(place, body.placement(time)).distance < (1.0 - k_deep) * radius) {
      stuck.note("'" + body.name + "'", place);
      return;
    }
  }
}

std::string counted(const Misplaced& some, std::size_t all) {
  return (some.count == all
              ? std::string("its grains")
              : std::to_string(some.count) + " of its first " + std::to_string(all) + " grains") +
         " would start ";
}

void report(const scenario::EmitterSpec& spec, const Misplaced& outside, const Misplaced& stuck,
            std::size_t all, scenario::Diagnostics& diagnostics) {
  if (stuck.count > 0) {
    diagnostics.error(spec.model.where,
                      spec.model.path + ": " + counted(stuck, all) + "inside " + stuck.what +
                          ", the first at " + base::place_text(stuck.first) +
                          ": they would be thrown out of it; move the emitter or make it smaller, "
                          "so that a diameter of room is left on all sides");
  }
  if (outside.count == 0) return;
  const std::string text = spec.model.path + ": " + counted(outside, all) + "beyond " +
                           outside.what + ", the first at " + base::place_text(outside.first) +
                           ", and be gone at once: move the emitter into the domain";
  if (outside.count == all) {
    diagnostics.error(spec.model.where, text);
  } else {
    diagnostics.warning(spec.model.where, text);
  }
}

/// [s] In which a lone grain takes on the velocity of the fluid by Stokes' drag,
/// \f$ \rho d^2 / (18 \mu) \f$; infinite without a fluid.
double relaxation_time(const scenario::Setup& setup, const scenario::EmitterSpec& spec,
                       double diameter) {
  if (!setup.fluid) return std::numeric_limits<double>::infinity();
  const auto& material = setup.materials[static_cast<std::size_t>(spec.material)];
  return material.properties.density * diameter * diameter / (18.0 * setup.fluid->viscosity);
}

/// Warns of a stream that falls out of the domain and meets nothing, where bodies are there to be
/// met and the grains are too heavy for the fluid to carry them.
void check_way(const scenario::Setup& setup, const ParticleModels& models,
               const scenario::EmitterSpec& spec, const std::vector<sdk::InsertionRequest>& grains,
               scenario::Diagnostics& diagnostics) {
  constexpr std::size_t k_followed = 8;
  if (grains.empty() || setup.bodies.empty()) return;
  const std::size_t all = std::min(k_followed, grains.size());
  double longest = 0.0;
  for (std::size_t q = 0; q < all; ++q) {
    const sdk::InsertionRequest& grain = grains[q * grains.size() / all];
    const Journey journey =
        follow_grain(setup, models.bodies, grain, std::numeric_limits<double>::infinity());
    if (std::isfinite(journey.first_touch) || !std::isfinite(journey.duration)) return;
    if (relaxation_time(setup, spec, grain.diameter) < journey.duration) return;
    longest = std::max(longest, journey.duration);
  }
  diagnostics.warning(spec.model.where,
                      spec.model.path + ": its grains leave the domain after at most " +
                          base::digits_text(longest, 2) +
                          " s of free fall and meet nothing on their way; are its place and "
                          "velocity and the sign of gravity, " +
                          base::place_text(setup.gravity) + "/s2, right?");
}

/// Warns of a stream that never begins.
void check_times(const scenario::Setup& setup, const scenario::EmitterSpec& spec,
                 const sdk::Emitter& emitter, scenario::Diagnostics& diagnostics) {
  const sdk::EmitterRequest request = emitter.request();
  const auto seconds = [](double time) { return scenario::number_text(time) + " s"; };
  if (!(request.mass_flow > 0.0)) return;
  const std::string none = ": no grain of it comes";
  if (!(request.end > request.begin)) {
    diagnostics.warning(spec.model.where, spec.model.path + ": ends at " + seconds(request.end) +
                                              ", before it begins at " + seconds(request.begin) +
                                              none);
  } else if (!(setup.time.end > request.begin)) {
    diagnostics.warning(spec.model.where,
                        spec.model.path + ": begins at " + seconds(request.begin) +
                            ", when the run has ended, at " + seconds(setup.time.end) + none);
  }
}

}  // namespace

bool may_be_gone(const scenario::BodySpec& body, double time, double fluid_step) {
  if (!body.removal) return false;
  const double rounding = 1e-6 * fluid_step;
  const bool is_by_energy = body.removal->kinetic_energy_per_grain > 0.0;
  return time >= body.removal->at - rounding || (is_by_energy && time >= body.removal->after);
}

void check_release(const scenario::Setup& setup, const scenario::DustSetup& dust,
                   const ParticleModels& models,
                   std::span<const std::vector<sdk::InsertionRequest>> first,
                   scenario::Diagnostics& diagnostics) {
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    check_times(setup, setup.emitters[n], *models.emitters[n], diagnostics);
    if (!models.emitters[n]->insertion_rule().waits) continue;
    const std::vector<sdk::InsertionRequest>& grains = first[n];
    const std::size_t all = std::min(k_sample, grains.size());
    Misplaced outside;
    Misplaced stuck;
    for (std::size_t q = 0; q < all; ++q) {
      const sdk::InsertionRequest& grain = grains[q * grains.size() / all];
      const Vec3 place = release_of(setup, grain);
      const double radius = 0.5 * grain.diameter;
      const std::size_t before = stuck.count + outside.count;
      look_at_sides(setup, dust, place, radius, outside, stuck);
      if (stuck.count + outside.count > before) continue;
      look_at_bodies(setup, models.bodies, place, radius, grain.time, stuck);
    }
    report(setup.emitters[n], outside, stuck, all, diagnostics);
    if (stuck.count + outside.count == 0) {
      check_way(setup, models, setup.emitters[n], grains, diagnostics);
    }
  }
}

}  // namespace dust::preflight

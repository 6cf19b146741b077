// SPDX-License-Identifier: Apache-2.0
#include "preflight/derived.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "dust/sdk/random.hpp"
#include "dust/sdk/sphere.hpp"
#include "fluid/grid.hpp"
#include "preflight/cost.hpp"
#include "preflight/particle_models.hpp"
#include "resolved/marker_lattice.hpp"
#include "scenario/text/units.hpp"
#include "setup/mark.hpp"

#include <algorithm>
#include <cmath>

namespace dust::preflight {
namespace {

// Below this many steps a collision is missed or throws the grains apart.
constexpr double k_min_steps_per_collision = 3.0;

using Emitters = std::vector<std::unique_ptr<sdk::Emitter>>;
using scenario::EmitterSpec;
using scenario::number_text;
using scenario::Setup;

/// Three digits, for messages.
std::string short_number(double value) { return base::digits_text(value, 3); }

double largest_speed(const bodies::BodySet& bodies) {
  double speed = 0.0;
  for (const auto& body : bodies) speed = std::max(speed, body.largest_speed());
  return speed;
}

particles::TimeSteps derive_steps(const Setup& setup, const ParticleModels& models) {
  if (!models.class_diameters.empty()) {
    return particles::time_steps(setup, models.bodies, models.laws, models.class_diameters);
  }
  // Nothing shortens the step of grains that never come.
  particles::TimeSteps steps;
  steps.coarse_step = setup.time.fluid_step;
  return steps;
}

double expected_speed(const Setup& setup, const Emitters& emitters, double body_speed) {
  if (setup.time.expected_speed > 0.0) return setup.time.expected_speed;
  double speed = body_speed;
  for (const auto& emitter : emitters) speed = std::max(speed, emitter->largest_speed());
  // v^2 = v_0^2 + 2 g h
  return std::sqrt(speed * speed + 2.0 * norm(setup.gravity) * fall_height(setup));
}

/// [kg] of a grain on average; 0 where the emitter does not say which sizes come.
double mean_mass(const sdk::EmitterRequest& request, double density) {
  double mass = 0.0;
  double all = 0.0;
  for (const auto& share : request.shares) {
    mass += share.number_fraction * density * sdk::sphere_volume(share.diameter);
    all += share.number_fraction;
  }
  return all > 0.0 ? mass / all : 0.0;
}

/// Lets a fresh emitter propose the grains of a short time from `request.begin` on; `step` [s] at a
/// time.
void count_stream(const Setup& setup, const EmitterSpec& spec, double step,
                  const sdk::EmitterRequest& request, sdk::Emitter& emitter,
                  EmissionNumbers& numbers) {
  constexpr int k_max_steps = 50;
  constexpr std::size_t k_enough = 20000;
  std::vector<sdk::InsertionRequest> requests;
  const double end = std::min(setup.time.end, request.end);
  double time = request.begin;
  const double stop = std::min(end, time + k_max_steps * setup.time.fluid_step);
  while (time < stop && requests.size() < k_enough) {
    sdk::EmitterContext context;
    context.begin = time;
    context.end = time + step;
    context.grain_density =
        setup.materials[static_cast<std::size_t>(spec.material)].properties.density;
    context.gravity = setup.gravity;
    context.random = sdk::Random(setup.seed, sdk::stream_of(spec.name.c_str()));
    try {
      emitter.propose(context, requests);
    } catch (const std::exception& e) {
      throw base::UserError(scenario::place(spec.model.where) + ": error: " + spec.model.path +
                            ": " + e.what());
    }
    time = context.end;
  }
  const double duration = time - request.begin;
  if (!(duration > 0.0)) return;
  if (!emitter.insertion_rule().waits) {
    numbers.at_once = static_cast<double>(requests.size());
    return;
  }
  for (const sdk::InsertionRequest& one : requests) numbers.real_per_second += one.weight;
  numbers.real_per_second /= duration;
  numbers.computed_per_second = static_cast<double>(requests.size()) / duration;
}

/// From what the emitter says of itself, where that is enough; else from what it proposes.
EmissionNumbers count_grains(const Setup& setup, const EmitterSpec& spec, sdk::Emitter& emitter) {
  // More grains per fluid step than any run can follow: counted by shares alone.
  constexpr double k_too_many = 2e5;
  constexpr double k_at_a_time = 5000.0;
  EmissionNumbers numbers;
  numbers.emitter = spec.name;
  numbers.mass_flow = emitter.requested_mass_flow();
  const auto request = emitter.request();
  const double density =
      setup.materials[static_cast<std::size_t>(spec.material)].properties.density;
  const double mass = mean_mass(request, density);
  if (!emitter.insertion_rule().waits &&
      (request.count > 0 || (request.mass > 0.0 && mass > 0.0))) {
    numbers.at_once =
        request.count > 0 ? static_cast<double>(request.count) : std::round(request.mass / mass);
    numbers.volume_at_once = numbers.at_once * mass / density;
    return numbers;
  }
  const double per_second = mass > 0.0 ? request.mass_flow / mass : 0.0;
  if (per_second * setup.time.fluid_step > k_too_many) {
    numbers.real_per_second = per_second;
    numbers.computed_per_second = per_second;
    return numbers;
  }
  const double step = per_second > 0.0 ? std::min(setup.time.fluid_step, k_at_a_time / per_second)
                                       : setup.time.fluid_step;
  count_stream(setup, spec, step, request, emitter, numbers);
  return numbers;
}

void derive_ratios(const Setup& setup, Derived& derived) {
  const sdk::Vec3 size = setup.domain.max - setup.domain.min;
  const auto& classes = derived.steps.classes;
  const double largest = classes.empty() ? 0.0 : classes.back().diameter;
  if (largest > 0.0) derived.width_over_diameter = std::min({size.x, size.y, size.z}) / largest;
  if (!setup.fluid) return;
  const sdk::Vec3 h =
      fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, {}).spacing;
  derived.smallest_spacing = std::min({h.x, h.y, h.z});
  derived.mean_spacing = std::cbrt(h.x * h.y * h.z);
  derived.diameter_over_spacing = largest / derived.smallest_spacing;
  derived.courant_number =
      derived.expected_speed * setup.time.fluid_step / derived.smallest_spacing;
}

void derive_resolved(const Setup& setup, const ParticleModels& models, Derived& derived) {
  if (!setup.fluid) return;
  const sdk::Vec3 h =
      fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, {}).spacing;
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const EmitterSpec& emitter = setup.emitters[n];
    const int material =
        emitter.more_materials.empty() ? emitter.material : emitter.more_materials.front();
    const auto diameters = models.emitters[n]->diameters();
    if (!setup.fluid->resolves(material) || diameters.empty()) continue;
    const double least = *std::min_element(diameters.begin(), diameters.end());
    derived.resolved.push_back({emitter.name, least, least / std::max({h.x, h.y, h.z}),
                                resolved::marker_count(least / derived.mean_spacing)});
  }
}

}  // namespace

particles::TimeSteps derive_steps(const Setup& setup, const registry::Registry& registry) {
  return derive_steps(setup, make_particle_models(setup, registry));
}

void check_fixed_step(const Setup& setup, const registry::Registry& registry,
                      scenario::Diagnostics& diagnostics) {
  const double step = setup.time.dem_step;
  if (!(step > 0.0)) return;
  const particles::TimeSteps steps = derive_steps(setup, registry);
  const particles::ClassStep* deciding = steps.coarse_deciding();
  if (deciding == nullptr) return;
  if (step <= deciding->stable_step) return;
  const bool is_hopeless =
      step > deciding->rayleigh_time || k_min_steps_per_collision * step > deciding->hertz_time;
  const std::string text =
      "time.dem_step: " + number_text(step) + " s is longer than the stable step of grains of " +
      short_number(deciding->diameter) + " m, " + short_number(deciding->stable_step) +
      " s (Rayleigh time " + short_number(deciding->rayleigh_time) + " s, shortest collision " +
      short_number(deciding->hertz_time) + " s at " + short_number(steps.expected_speed) +
      " m/s): " +
      (is_hopeless ? "the grains would fly apart; leave dem_step out or give at most that"
                   : "collisions lose their accuracy; leave dem_step out or give at most that");
  if (is_hopeless) {
    diagnostics.error(setup.time.dem_step_where, text);
  } else {
    diagnostics.warning(setup.time.dem_step_where, text);
  }
}

Derived derive(const Setup& setup, const registry::Registry& registry) {
  const ParticleModels models = make_particle_models(setup, registry);
  const double body_speed = largest_speed(models.bodies);
  Derived derived;
  derived.expected_speed = expected_speed(setup, models.emitters, body_speed);
  derived.steps = derive_steps(setup, models);
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    derived.emissions.push_back(count_grains(setup, setup.emitters[n], *models.emitters[n]));
  }
  derive_ratios(setup, derived);
  derive_resolved(setup, models, derived);
  estimate_cost(setup, body_speed, derived);
  return derived;
}

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#include "preflight/derived.hpp"

#include "base/text.hpp"
#include "dust/sdk/random.hpp"
#include "fluid/grid.hpp"
#include "preflight/cost.hpp"
#include "preflight/particle_models.hpp"
#include "scenario/units.hpp"

#include <algorithm>
#include <cmath>

namespace dust::preflight {
namespace {

// Below this many steps a collision is missed or throws the grains apart.
constexpr double k_fewest_steps_per_collision = 3.0;

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

/// Lets a fresh emitter propose the grains of a short time and counts them.
EmissionNumbers count_grains(const Setup& setup, const EmitterSpec& spec, sdk::Emitter& emitter) {
  EmissionNumbers numbers;
  numbers.emitter = spec.name;
  numbers.mass_flow = emitter.requested_mass_flow();
  const auto request = emitter.request();
  if (!emitter.insertion_rule().waits && request.count > 0) {
    numbers.at_once = static_cast<double>(request.count);
    return numbers;
  }
  constexpr int k_most_steps = 50;
  constexpr std::size_t k_enough = 20000;
  std::vector<sdk::InsertionRequest> requests;
  double time = 0.0;
  for (int n = 0; n < k_most_steps && time < setup.time.end && requests.size() < k_enough; ++n) {
    sdk::EmitterContext context;
    context.begin = time;
    context.end = time + setup.time.fluid_step;
    context.grain_density =
        setup.materials[static_cast<std::size_t>(spec.material)].properties.density;
    context.gravity = setup.gravity;
    context.random = sdk::Random(setup.seed, sdk::stream_of(spec.name.c_str()));
    emitter.propose(context, requests);
    time = context.end;
  }
  if (!(time > 0.0)) return numbers;
  if (!emitter.insertion_rule().waits) {
    numbers.at_once = static_cast<double>(requests.size());
    return numbers;
  }
  for (const sdk::InsertionRequest& one : requests) numbers.real_per_second += one.weight / time;
  numbers.computed_per_second = static_cast<double>(requests.size()) / time;
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
      step > deciding->rayleigh_time || k_fewest_steps_per_collision * step > deciding->hertz_time;
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
  estimate_cost(setup, body_speed, derived);
  return derived;
}

}  // namespace dust::preflight

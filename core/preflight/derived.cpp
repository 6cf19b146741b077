// SPDX-License-Identifier: Apache-2.0
#include "preflight/derived.hpp"

#include "bodies/body_set.hpp"
#include "dust/sdk/emitter.hpp"
#include "dust/sdk/motion.hpp"
#include "dust/sdk/random.hpp"
#include "dust/sdk/sphere.hpp"
#include "particles/time_steps.hpp"
#include "preflight/cost.hpp"
#include "scenario/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace dust::preflight {
namespace {

// Shares of the Rayleigh and Hertz times that keep a collision accurate (a realised restitution
// within 0.01 of the declared one).
constexpr double k_rayleigh_share = 0.3;
constexpr double k_steps_per_collision = 15.0;
// Below this many steps a collision is missed or throws the grains apart.
constexpr double k_fewest_steps_per_collision = 3.0;
// Grains below this share of the largest diameter are sub-cycled.
constexpr double k_coarse_share = 1.0 / 8.0;
// Forgives the rounding of a quotient that is a whole number.
constexpr double k_whole_slack = 1e-9;

using scenario::BodySpec;
using scenario::EmitterSpec;
using scenario::InteractionSpec;
using scenario::ModelChoice;
using scenario::number_text;
using scenario::Setup;

using Emitters = std::vector<std::unique_ptr<sdk::Emitter>>;

Emitters make_emitters(const Setup& setup, const registry::Registry& registry) {
  Emitters emitters;
  for (const EmitterSpec& spec : setup.emitters) {
    emitters.push_back(registry.create_as<sdk::Emitter>(spec.model));
  }
  return emitters;
}

/// Three digits, for messages.
std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

double largest_body_speed(const Setup& setup, const registry::Registry& registry) {
  double speed = 0.0;
  for (const BodySpec& body : setup.bodies) {
    std::vector<std::unique_ptr<sdk::Motion>> motions;
    for (const ModelChoice& motion : body.motions) {
      motions.push_back(registry.create_as<sdk::Motion>(motion));
    }
    if (motions.empty()) continue;
    speed = std::max(speed, bodies::make_body(setup, body, std::move(motions)).largest_speed());
  }
  return speed;
}

double expected_speed(const Setup& setup, const Emitters& emitters, double body_speed) {
  if (setup.time.expected_speed > 0.0) return setup.time.expected_speed;
  double speed = body_speed;
  for (const auto& emitter : emitters) speed = std::max(speed, emitter->largest_speed());
  // v^2 = v_0^2 + 2 g h
  return std::sqrt(speed * speed + 2.0 * norm(setup.gravity) * fall_height(setup));
}

/// As the run takes it (particles/time_steps.hpp).
double impact_speed(const Setup& setup, double body_speed) {
  if (setup.time.expected_speed > 0.0) return setup.time.expected_speed;
  return std::max(particles::k_default_speed, body_speed);
}

/// The shortest collision of a grain with its like or with a wall of any material it may meet.
void find_hertz_time(const Setup& setup, const registry::Registry& registry, double speed,
                     SizeNumbers& size) {
  const double radius = 0.5 * size.diameter;
  const auto material = [&](int n) { return setup.materials[static_cast<std::size_t>(n)]; };
  const double mass =
      material(size.material).properties.density * sdk::sphere_volume(size.diameter);
  size.hertz_time = std::numeric_limits<double>::infinity();
  for (const InteractionSpec& pair : setup.interactions) {
    if (pair.material_i != size.material && pair.material_j != size.material) continue;
    const int other = pair.material_i == size.material ? pair.material_j : pair.material_i;
    const auto law = registry.create_as<sdk::ContactLaw>(pair.contact);
    law->prepare(material(pair.material_i).properties, material(pair.material_j).properties);
    // Two equal grains: R* = R/2, m* = m/2; a wall: R* = R, m* = m.
    const double share = other == size.material ? 0.5 : 1.0;
    double time = law->collision_time(share * radius, share * mass, speed);
    if (pair.cohesion) {
      // Grains that stick swing about their overlap at rest.
      const auto cohesion = registry.create_as<sdk::CohesionLaw>(*pair.cohesion);
      cohesion->prepare(material(pair.material_i).properties, material(pair.material_j).properties);
      time = std::min(time, law->half_period(share * radius, share * mass,
                                             cohesion->resting_overlap(share * radius)));
    }
    if (time < size.hertz_time) {
      size.hertz_time = time;
      size.partner = material(other).name;
    }
  }
}

void derive_steps(const Setup& setup, const registry::Registry& registry, const Emitters& emitters,
                  Derived& derived) {
  for (std::size_t n = 0; n < emitters.size(); ++n) {
    const int material = setup.emitters[n].material;
    for (const double diameter : emitters[n]->diameters()) {
      const bool is_known = std::any_of(
          derived.sizes.begin(), derived.sizes.end(),
          [&](const SizeNumbers& s) { return s.material == material && s.diameter == diameter; });
      if (is_known) continue;
      SizeNumbers size;
      size.material = material;
      size.diameter = diameter;
      size.rayleigh_time = rayleigh_time(
          0.5 * diameter, setup.materials[static_cast<std::size_t>(material)].properties);
      find_hertz_time(setup, registry, derived.impact_speed, size);
      size.stable_step =
          std::min(k_rayleigh_share * size.rayleigh_time, size.hertz_time / k_steps_per_collision);
      derived.sizes.push_back(size);
    }
  }
  std::stable_sort(
      derived.sizes.begin(), derived.sizes.end(),
      [](const SizeNumbers& a, const SizeNumbers& b) { return a.diameter < b.diameter; });
  if (derived.sizes.empty()) return;
  if (!setup.time.rates_single) {
    derived.coarse_limit = k_coarse_share * derived.sizes.back().diameter * (1.0 - 1e-12);
  }
  for (std::size_t n = 0; n < derived.sizes.size(); ++n) {
    const double step = derived.sizes[n].stable_step;
    if (derived.deciding_size < 0 || step < derived.smallest_step) {
      derived.deciding_size = static_cast<int>(n);
      derived.smallest_step = step;
    }
    if (derived.sizes[n].diameter < derived.coarse_limit) continue;
    if (derived.coarse_deciding_size < 0 || step < derived.largest_step) {
      derived.coarse_deciding_size = static_cast<int>(n);
      derived.largest_step = step;
    }
  }
  if (setup.time.dem_step > 0.0) {
    derived.smallest_step = derived.largest_step = setup.time.dem_step;
  }
  // As the run does: a whole number of steps per fluid step.
  const double interval = setup.time.fluid_step;
  derived.largest_step =
      interval / std::max(1.0, std::ceil(interval / derived.largest_step - k_whole_slack));
  derived.smallest_step = std::min(derived.smallest_step, derived.largest_step);
}

/// Lets a fresh emitter propose the grains of a short time and counts them.
EmissionNumbers count_grains(const Setup& setup, const EmitterSpec& spec, sdk::Emitter& emitter) {
  EmissionNumbers numbers;
  numbers.emitter = spec.name;
  numbers.mass_flow = emitter.requested_mass_flow();
  const auto request = emitter.request();
  if (!emitter.entry_rule().waits && request.count > 0) {
    numbers.at_once = static_cast<double>(request.count);
    return numbers;
  }
  constexpr int k_most_steps = 50;
  constexpr std::size_t k_enough = 20000;
  std::vector<sdk::Seed> seeds;
  double time = 0.0;
  for (int n = 0; n < k_most_steps && time < setup.time.end && seeds.size() < k_enough; ++n) {
    sdk::EmitterContext context;
    context.begin = time;
    context.end = time + setup.time.fluid_step;
    context.grain_density =
        setup.materials[static_cast<std::size_t>(spec.material)].properties.density;
    context.gravity = setup.gravity;
    context.random = sdk::Random(setup.seed, sdk::stream_of(spec.name.c_str()));
    emitter.propose(context, seeds);
    time = context.end;
  }
  if (!(time > 0.0)) return numbers;
  if (!emitter.entry_rule().waits) {
    numbers.at_once = static_cast<double>(seeds.size());
    return numbers;
  }
  for (const sdk::Seed& seed : seeds) numbers.real_per_second += seed.weight / time;
  numbers.computed_per_second = static_cast<double>(seeds.size()) / time;
  return numbers;
}

void derive_ratios(const Setup& setup, Derived& derived) {
  const sdk::Vec3 size = setup.domain.max - setup.domain.min;
  const double largest = derived.sizes.empty() ? 0.0 : derived.sizes.back().diameter;
  if (largest > 0.0) derived.width_over_diameter = std::min({size.x, size.y, size.z}) / largest;
  if (!setup.fluid) return;
  derived.smallest_spacing = std::numeric_limits<double>::infinity();
  double volume = 1.0;
  for (int d = 0; d < 3; ++d) {
    const double spacing = size[d] / setup.fluid->cells[static_cast<std::size_t>(d)];
    derived.smallest_spacing = std::min(derived.smallest_spacing, spacing);
    volume *= spacing;
  }
  derived.mean_spacing = std::cbrt(volume);
  derived.diameter_over_spacing = largest / derived.smallest_spacing;
  derived.courant_number =
      derived.expected_speed * setup.time.fluid_step / derived.smallest_spacing;
}

}  // namespace

double rayleigh_time(double radius, const sdk::MaterialProperties& m) {
  const double shear_modulus = m.young_modulus / (2.0 * (1.0 + m.poisson_ratio));
  return std::numbers::pi * radius * std::sqrt(m.density / shear_modulus) /
         (0.1631 * m.poisson_ratio + 0.8766);
}

void check_fixed_step(const Setup& setup, const registry::Registry& registry,
                      scenario::Diagnostics& diagnostics) {
  const double step = setup.time.dem_step;
  if (!(step > 0.0)) return;
  const Emitters emitters = make_emitters(setup, registry);
  Derived derived;
  derived.impact_speed = impact_speed(setup, largest_body_speed(setup, registry));
  derive_steps(setup, registry, emitters, derived);
  if (derived.sizes.empty()) return;
  const SizeNumbers* deciding =
      &derived.sizes[static_cast<std::size_t>(derived.coarse_deciding_size)];
  if (step <= deciding->stable_step) return;
  const bool is_hopeless =
      step > deciding->rayleigh_time || k_fewest_steps_per_collision * step > deciding->hertz_time;
  const std::string text =
      "time.dem_step: " + number_text(step) + " s is longer than the stable step of grains of " +
      short_number(deciding->diameter) + " m, " + short_number(deciding->stable_step) +
      " s (Rayleigh time " + short_number(deciding->rayleigh_time) + " s, shortest collision " +
      short_number(deciding->hertz_time) + " s at " + short_number(derived.impact_speed) +
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
  Derived derived;
  const Emitters emitters = make_emitters(setup, registry);
  const double body_speed = largest_body_speed(setup, registry);
  derived.expected_speed = expected_speed(setup, emitters, body_speed);
  derived.impact_speed = impact_speed(setup, body_speed);
  derive_steps(setup, registry, emitters, derived);
  for (std::size_t n = 0; n < emitters.size(); ++n) {
    derived.emissions.push_back(count_grains(setup, setup.emitters[n], *emitters[n]));
  }
  derive_ratios(setup, derived);
  estimate_cost(setup, body_speed, derived);
  return derived;
}

}  // namespace dust::preflight

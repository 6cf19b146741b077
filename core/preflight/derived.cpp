// SPDX-License-Identifier: Apache-2.0
#include "preflight/derived.hpp"

#include "base/text.hpp"
#include "coupling/self_disturbance/disturbance_formulas.hpp"
#include "fluid/grid.hpp"
#include "preflight/air/driven_speed.hpp"
#include "preflight/cost.hpp"
#include "preflight/emissions.hpp"
#include "preflight/particle_models.hpp"
#include "preflight/places/fall.hpp"
#include "resolved/marker_lattice.hpp"
#include "scenario/text/units.hpp"
#include "setup/mark.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::preflight {
namespace {

// Below this many steps a collision is missed or throws the grains apart.
constexpr double k_min_steps_per_collision = 3.0;

// Share of a free fall's speed that falling grains give the fluid.
constexpr double k_dragged_share = 0.5;

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
    return particles::time_steps(setup, models.bodies, models.laws, models.class_diameters,
                                 models.release_speed);
  }
  // Nothing shortens the step of grains that never come.
  particles::TimeSteps steps;
  steps.coarse_step = setup.time.fluid_step;
  return steps;
}

/// [m/s] after a free fall through the domain.
double free_fall_speed(const Setup& setup) {
  return std::sqrt(2.0 * norm(setup.gravity) * fall_height(setup));
}

double expected_speed(const Setup& setup, const Emitters& emitters, double body_speed) {
  if (setup.time.expected_speed > 0.0) return setup.time.expected_speed;
  double speed = body_speed;
  for (const auto& emitter : emitters) speed = std::max(speed, emitter->largest_speed());
  return std::hypot(speed, free_fall_speed(setup));
}

/// [m/s] What falling grains and dust give the fluid: streams a share of their own speed; spheres
/// that the grid resolves are few, and no faster than one alone.
double fall_speed(const Setup& setup, const Emitters& emitters, const scenario::DustSetup& dust) {
  const double free = free_fall_speed(setup);
  double speed = dust.field && !dust.field->sources.empty() ? k_dragged_share * free : 0.0;
  for (std::size_t n = 0; n < emitters.size(); ++n) {
    double own = k_dragged_share * free;
    const int material = setup.emitters[n].material;
    const auto diameters = emitters[n]->diameters();
    if (setup.fluid && setup.fluid->resolves(material) && !diameters.empty()) {
      const double density = setup.materials[static_cast<std::size_t>(material)].properties.density;
      const double largest = *std::max_element(diameters.begin(), diameters.end());
      own = std::min(free, settling_speed(setup, largest, density));
    }
    speed = std::max(speed, own);
  }
  return speed;
}

/// [m/s] that streams can give the fluid by their weight: in the middle of a plume that falls from
/// the top, at a tenth of the height, \f$ w = 4.7 (g \dot m / \rho_f)^{1/3} z^{-1/3} \f$ (Rouse,
/// Yih and Humphreys, Tellus 4 (1952) 201). Infinite with grains that are there at once.
double plume_speed(const Setup& setup, const std::vector<EmissionNumbers>& emissions,
                   const scenario::DustSetup& dust) {
  double mass_flow = 0.0;
  if (dust.field) {
    for (const scenario::DustSourceSpec& source : dust.field->sources) {
      for (const double flow : source.mass_flow) mass_flow += flow;
    }
  }
  for (const EmissionNumbers& e : emissions) {
    if (e.at_once > 0.0) return std::numeric_limits<double>::infinity();
    mass_flow += e.mass_flow;
  }
  const double height = 0.1 * fall_height(setup);
  if (!(height > 0.0)) return std::numeric_limits<double>::infinity();
  return 4.7 * std::cbrt(norm(setup.gravity) * mass_flow / (setup.fluid->density * height));
}

/// [m/s] of the fluid where it is fast, for the number of its sub-steps: what drives it, and of
/// what grains do to it as much as they can by their speed and by their weight. `driven`: by sides
/// and openings.
double air_speed(const Setup& setup, const Emitters& emitters, const Derived& derived,
                 const scenario::DustSetup& dust, double body_speed, double driven) {
  if (!setup.fluid) return 0.0;
  const double forced = std::max(body_speed, driven);
  double speed = body_speed;
  for (const auto& emitter : emitters) speed = std::max(speed, emitter->largest_speed());
  const double by_grains = std::min(std::hypot(speed, fall_speed(setup, emitters, dust)),
                                    plume_speed(setup, derived.emissions, dust));
  const double expected = setup.time.expected_speed;
  return std::max(forced,
                  expected > 0.0 && !emitters.empty() ? std::min(expected, by_grains) : by_grains);
}

/// [s] When dust first gets into the air: from a source, or where grains that carry it meet
/// something; at once where a cloud or a wind has it.
double dust_begin(const scenario::DustFieldSpec& field,
                  const std::vector<EmissionNumbers>& emissions) {
  if (!field.clouds.empty()) return 0.0;
  double begin = std::numeric_limits<double>::infinity();
  for (const scenario::DustSourceSpec& source : field.sources)
    begin = std::min(begin, source.begin);
  for (const EmissionNumbers& e : emissions) begin = std::min(begin, e.begin + e.first_touch);
  return std::isfinite(begin) ? begin : 0.0;
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
  if (setup.fluid->resolved.empty()) {
    const auto& classes = derived.steps.classes;
    derived.largest_unresolved = classes.empty() ? 0.0 : classes.back().diameter;
    return;
  }
  const sdk::Vec3 h =
      fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, {}).spacing;
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const EmitterSpec& emitter = setup.emitters[n];
    const int material =
        emitter.more_materials.empty() ? emitter.material : emitter.more_materials.front();
    const auto diameters = models.emitters[n]->diameters();
    if (diameters.empty()) continue;
    if (!setup.fluid->resolves(material)) {
      derived.largest_unresolved = std::max(derived.largest_unresolved,
                                            *std::max_element(diameters.begin(), diameters.end()));
      continue;
    }
    const double least = *std::min_element(diameters.begin(), diameters.end());
    derived.resolved.push_back({emitter.name, least, least / std::max({h.x, h.y, h.z}),
                                resolved::marker_count(least / derived.mean_spacing)});
  }
}

/// What runs out of the bed that all emitters' fillings make together.
SlopeDrain drain_of_all(const Setup& setup, const bodies::BodySet& bodies,
                        const std::vector<EmissionNumbers>& emissions) {
  double solids = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const EmissionNumbers& e : emissions) {
    if (!(e.at_once > 0.0) || e.sizes.empty()) continue;
    solids += e.volume_at_once;
    smallest = std::min(smallest, e.sizes.front().diameter);
  }
  return solids > 0.0 ? slope_drain(setup, bodies, solids, 0.5 * smallest) : SlopeDrain{};
}

}  // namespace

bool is_self_disturbance_corrected(const Setup& setup, const Derived& derived, double diameter) {
  using Mode = scenario::DisturbanceCorrection;
  namespace disturbance = coupling::self_disturbance;
  if (!setup.fluid || setup.fluid->is_one_way) return false;
  const Mode mode = setup.fluid->disturbance_correction;
  if (mode == Mode::felt) return false;
  return disturbance::may_be_taken_off(diameter, derived.mean_spacing, derived.smallest_spacing,
                                       1.0, mode == Mode::taken_off ? 0.0 : disturbance::k_worth);
}

particles::TimeSteps derive_steps(const Setup& setup, const registry::Registry& registry) {
  return derive_steps(setup, make_particle_models(setup, registry));
}

void check_energy_account(const Setup& setup, const ParticleModels& models,
                          scenario::Diagnostics& diagnostics) {
  if (!setup.audit.energy || models.class_diameters.empty()) return;
  const particles::TimeSteps steps = derive_steps(setup, models);
  const particles::ClassStep& smallest = steps.classes.front();
  if (steps.is_coarse(smallest)) return;
  diagnostics.error(setup.audit.where,
                    "audit.energy: grains of " + base::length_text(smallest.diameter, 3) +
                        ", below an eighth of the largest, step at rates of their own and exchange "
                        "impulses that the account of a step does not hold; give `time: {rates: "
                        "single}` or leave the account out");
}

void check_step_count(const Setup& setup, const ParticleModels& models,
                      scenario::Diagnostics& diagnostics) {
  // At a million steps a second a fluid step would take a quarter of an hour.
  constexpr double k_largest_count = 1e9;
  if (models.class_diameters.empty() || setup.interactions.empty()) return;
  const bool is_given = setup.time.dem_step > 0.0;
  const double finest = is_given ? setup.time.dem_step : derive_steps(setup, models).finest_step();
  if (!(setup.time.fluid_step > k_largest_count * finest)) return;
  const std::string text = "a fluid step of " + short_number(setup.time.fluid_step) +
                           " s would be more than 1e9 steps of grains of " + short_number(finest) +
                           " s each, and not come to its end: ";
  if (is_given) {
    diagnostics.error(setup.time.dem_step_where,
                      "time.dem_step: " + text + "leave dem_step out, or give a longer one");
  } else {
    diagnostics.error(setup.interactions.front().where,
                      "interactions: " + text +
                          "are young_modulus and density right, and the collision_time that the "
                          "contact law tells?");
  }
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

Derived derive(const Setup& setup, const registry::Registry& registry,
               const scenario::DustSetup& dust, double begin) {
  const ParticleModels models = make_particle_models(setup, registry);
  const double body_speed = largest_speed(models.bodies);
  Derived derived;
  derived.expected_speed = expected_speed(setup, models.emitters, body_speed);
  derived.steps = derive_steps(setup, models);
  derived.impact = expected_impact(setup, models, registry);
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    derived.emissions.push_back(
        count_grains(setup, models.bodies, setup.emitters[n], *models.emitters[n]));
  }
  derived.drain = drain_of_all(setup, models.bodies, derived.emissions);
  const SideModelSet sides(setup, registry);
  derived.side_flows = side_flows(setup, sides.models());
  const double driven = driven_speed(setup, sides.models());
  if (!(setup.time.expected_speed > 0.0)) {
    derived.expected_speed = std::max(derived.expected_speed, driven);
  }
  derive_ratios(setup, derived);
  derive_resolved(setup, models, derived);
  derived.air_speed = air_speed(setup, models.emitters, derived, dust, body_speed, driven);
  derived.bodies = body_work(setup, models.bodies);
  if (dust.field) {
    derived.dust_classes = static_cast<int>(dust.field->diameters.size());
    derived.dust_begin = dust_begin(*dust.field, derived.emissions);
  }
  estimate_cost(setup, derived, begin);
  return derived;
}

}  // namespace dust::preflight

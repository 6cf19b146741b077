// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/time_steps.hpp"
#include "preflight/body_work.hpp"
#include "preflight/emissions.hpp"
#include "preflight/particle_models.hpp"
#include "preflight/run_cost.hpp"
#include "preflight/slope_drain.hpp"
#include "preflight/stiffness/softness.hpp"
#include "registry/registry.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <array>
#include <string>
#include <vector>

namespace dust::preflight {

/// Spheres that the grid resolves.
struct ResolvedNumbers {
  std::string emitter;
  double diameter = 0.0;  ///< [m] smallest of the emitter
  double cells = 0.0;     ///< across it, of the longest edge
  int markers = 0;        ///< on each
};

/// Numbers that follow from a scenario and tell whether it is sensible, before it is run.
struct Derived {
  double expected_speed = 0.0;  ///< [m/s] given, or of bodies, emitters, drops, openings and sides
  particles::TimeSteps steps;   ///< as the run takes them; without classes where no grains come
  ImpactOverlap impact;         ///< the softest, at the expected speed or that of a fall
  std::vector<EmissionNumbers> emissions;
  std::vector<ResolvedNumbers> resolved;
  double largest_unresolved = 0.0;  ///< [m] of the grains that the fluid meets by a drag law
  BodyWork bodies;
  SlopeDrain drain;                    ///< of the grains that are there at once
  int dust_classes = 0;                ///< that the fluid carries as concentrations
  double dust_begin = 0.0;             ///< [s] rough: when the first of it gets into the air
  std::array<double, 6> side_flows{};  ///< see side_flows()
  double smallest_spacing = 0.0;       ///< [m] 0 without fluid
  double mean_spacing = 0.0;           ///< [m] edge of a cube of a cell's volume
  double diameter_over_spacing = 0.0;  ///< largest grain over smallest cell edge
  double width_over_diameter = 0.0;    ///< narrowest extent over largest grain
  double courant_number = 0.0;         ///< at the expected speed with the fluid's step
  double air_speed = 0.0;              ///< [m/s] rough: of the fluid where it is fast
  double residence_time = 0.0;         ///< [s] rough: mean of the streams' grains
  double grains_in_domain = 0.0;       ///< rough: at most
  RunCost cost;                        ///< rough: on one processor, idle but for it
};

/// Whether what a lone grain of this diameter [m] does to the fluid by itself is taken off, by its
/// size and the cells'.
bool is_self_disturbance_corrected(const scenario::Setup& setup, const Derived& derived,
                                   double diameter);

/// The steps that a run will take.
particles::TimeSteps derive_steps(const scenario::Setup& setup, const registry::Registry& registry);

/// Refuses steps of grains so short that not even the first step of the fluid comes to its end.
void check_step_count(const scenario::Setup& setup, const ParticleModels& models,
                      scenario::Diagnostics& diagnostics);

/// Refuses an account of energy of grains that step at several rates.
void check_energy_account(const scenario::Setup& setup, const ParticleModels& models,
                          scenario::Diagnostics& diagnostics);

/// Is a fixed `time.dem_step` too long for the grains that take it? A warning above the stable
/// step, an error where a collision would not be seen or the grains would fly apart.
void check_fixed_step(const scenario::Setup& setup, const registry::Registry& registry,
                      scenario::Diagnostics& diagnostics);

/// Derives all numbers; makes the models it needs. `dust`: what the scenario says of it;
/// `begin` [s]: of the state of another run that it starts from.
Derived derive(const scenario::Setup& setup, const registry::Registry& registry,
               const scenario::DustSetup& dust = {}, double begin = 0.0);

}  // namespace dust::preflight

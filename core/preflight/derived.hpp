// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <string>
#include <vector>

namespace dust::preflight {

/// Times of the grains of one material and size.
struct SizeNumbers {
  int material = 0;            ///< index into Setup::materials
  double diameter = 0.0;       ///< [m]
  double rayleigh_time = 0.0;  ///< [s]
  double hertz_time = 0.0;     ///< [s] shortest collision at the expected speed
  std::string partner;         ///< material it collides with that quickly
  double stable_step = 0.0;    ///< [s] min(0.3 Rayleigh, Hertz / 15)
};

/// What an emitter sends.
struct EmissionNumbers {
  std::string emitter;
  double mass_flow = 0.0;            ///< [kg/s] as asked for
  double computed_per_second = 0.0;  ///< grains the engine follows
  double real_per_second = 0.0;      ///< the same, counted with their weights
  double at_once = 0.0;              ///< computed grains that come at one moment
};

/// Numbers that follow from a scenario and tell whether it is sensible, before it is run.
struct Derived {
  double expected_speed = 0.0;  ///< [m/s] of flow: given, or bodies, emitters and drops
  double impact_speed = 0.0;    ///< [m/s] of grains that meet, from which the steps follow
  std::vector<SizeNumbers> sizes;
  int deciding_size = -1;         ///< which of `sizes` sets the smallest step
  double smallest_step = 0.0;     ///< [s]
  double coarse_limit = 0.0;      ///< [m] grains from here on share the largest step
  double largest_step = 0.0;      ///< [s] a whole part of the fluid's step
  int coarse_deciding_size = -1;  ///< which of `sizes` sets it
  std::vector<EmissionNumbers> emissions;
  double smallest_spacing = 0.0;       ///< [m] 0 without fluid
  double mean_spacing = 0.0;           ///< [m] edge of a cube of a cell's volume
  double diameter_over_spacing = 0.0;  ///< largest grain over smallest cell edge
  double width_over_diameter = 0.0;    ///< narrowest extent over largest grain
  double courant_number = 0.0;         ///< at the expected speed with the fluid's step
  double residence_time = 0.0;         ///< [s] rough: fall plus transport through the domain
  double grains_in_domain = 0.0;       ///< rough
  double memory_bytes = 0.0;           ///< rough
  double disk_bytes = 0.0;             ///< rough: frames and checkpoint
  double core_seconds = 0.0;           ///< [s] rough: wall time on one core
};

/// Rayleigh time [s] of a sphere: \f$ T_R = \pi R \sqrt{\rho / G} / (0.1631 \nu + 0.8766) \f$,
/// R radius [m], \f$ G = E / (2 (1 + \nu)) \f$. The nu term stands outside the root (Johnson 1985).
double rayleigh_time(double radius, const sdk::MaterialProperties& material);

/// Is a fixed `time.dem_step` too long for the grains that take it? A warning above the stable
/// step, an error where a collision would not be seen or the grains would fly apart.
void check_fixed_step(const scenario::Setup& setup, const registry::Registry& registry,
                      scenario::Diagnostics& diagnostics);

/// Derives all numbers; makes the models it needs.
Derived derive(const scenario::Setup& setup, const registry::Registry& registry);

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/dem.hpp"

#include <set>
#include <span>
#include <vector>

namespace dust::particles {

/// Grains of at least this share of the largest diameter step at the coarse rate.
inline constexpr double k_coarse_share = 1.0 / 8.0;

/// Materials that grains have: those of the emitters; without any, all.
std::set<int> grain_materials(const scenario::Setup& setup);

/// Rayleigh time [s]: \f$ T_R = \pi R \sqrt{\rho/G} / (0.1631 \nu + 0.8766) \f$,
/// \f$ G = E / (2 (1 + \nu)) \f$. Source: Li, Xu, Thornton, Powder Technol. 160 (2005) 219.
double rayleigh_time(const sdk::MaterialProperties& material, double radius);

/// Approach speed [m/s] taken where a scenario gives none and no body or grain let in is faster:
/// the speed of a fall from 13 mm. Approach speeds in contacts count, not the speed of a free fall.
inline constexpr double k_default_speed = 0.5;

/// Shares of the Rayleigh and Hertz times that keep a collision accurate: how near to the declared
/// restitution the realised one is stands in docs/theory/grains.md, "The time step".
inline constexpr double k_rayleigh_share = 0.3;
inline constexpr double k_steps_per_collision = 15.0;

/// The steps of a scenario: what `engine check` tells, what a run takes and what its log and
/// summary hold. docs/theory/grains.md, "The time step".
struct TimeSteps {
  std::vector<ClassStep> classes;  ///< ascending diameters
  double coarse_step = 0.0;        ///< [s] a whole part of the fluid's step
  double expected_speed = 0.0;     ///< [m/s] of approach
  double coarse_limit = 0.0;       ///< [m] smallest diameter that steps at the coarse rate

  [[nodiscard]] bool is_coarse(const ClassStep& c) const { return c.diameter >= coarse_limit; }
  /// [s] The shortest step that grains of the class make: where they meet others, if they are fine.
  [[nodiscard]] double step_of(const ClassStep& c) const;
  /// [s] The shortest step of all.
  [[nodiscard]] double finest_step() const;
  /// The class with the smallest stable step, of all or of those at the coarse rate; null without
  /// classes.
  [[nodiscard]] const ClassStep* deciding() const;
  [[nodiscard]] const ClassStep* coarse_deciding() const;
};

/// Derives the steps of grains of `diameters` (all that may come, ascending, at least one), each of
/// any material that grains have here: a diameter does not tell its material. The fastest is let in
/// at `release_speed` [m/s].
TimeSteps time_steps(const scenario::Setup& setup, const bodies::BodySet& bodies,
                     std::span<const PairLaws> laws, std::span<const double> diameters,
                     double release_speed);

}  // namespace dust::particles

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/dem.hpp"

#include <span>
#include <vector>

namespace dust::particles {

/// Grains of at least this share of the largest diameter step at the coarse rate.
inline constexpr double k_coarse_share = 1.0 / 8.0;

/// Rayleigh time [s]: \f$ T_R = \pi R \sqrt{\rho/G} / (0.1631 \nu + 0.8766) \f$,
/// \f$ G = E / (2 (1 + \nu)) \f$. Source: Li, Xu, Thornton, Powder Technol. 160 (2005) 219.
double rayleigh_time(const sdk::MaterialProperties& material, double radius);

/// Approach speed [m/s] taken where a scenario gives none and no body moves faster: the speed of a
/// fall from 13 mm. Approach speeds in contacts count, not the speed of a free fall.
inline constexpr double k_default_speed = 0.5;

struct TimeSteps {
  std::vector<ClassStep> classes;
  double coarse_step = 0.0;
  double expected_speed = 0.0;
  double coarse_limit = 0.0;  ///< [m] smallest diameter that steps at the coarse rate
};

TimeSteps time_steps(const scenario::Setup& setup, const bodies::BodySet& bodies,
                     std::span<const PairLaws> laws, std::span<const double> diameters);

}  // namespace dust::particles

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <cstddef>
#include <string>

namespace dust::preflight {

/// The softest impact of a scenario: that of the largest overlap over the radius.
struct ImpactOverlap {
  double ratio = 0.0;           ///< [-] overlap / smaller radius; 0 without grains that move
  double diameter = 0.0;        ///< [m] of the grain, the smaller of two
  double speed = 0.0;           ///< [m/s] of the impact
  std::size_t interaction = 0;  ///< whose law it is, as Setup::interactions
  bool is_hertz = false;        ///< the elastic force is that of Hertz
};

/// Above this overlap over the radius grains are soft, docs/result_files.md, "health": said in the
/// line of `engine check`. Many scenarios are so on purpose, for longer steps.
inline constexpr double k_soft_overlap = 0.05;
/// Above this one a scenario is warned of: mostly a missing MPa.
inline constexpr double k_warned_overlap = 0.3;

/// The overlap of elastic head-on impacts at `speed` [m/s], of all kinds of grains against walls
/// and each other, from the law's own collision time: \f$ \delta = v t_c / 2.943 \f$ where the
/// elastic force is that of Hertz, \f$ \delta = v t_c / \pi \f$ where it is linear. Source:
/// Johnson, Contact Mechanics (1985), eq. (11.24).
ImpactOverlap softest_impact(const scenario::Setup& setup, const ParticleModels& models,
                             double speed);

/// What to write so that E* of a pair is `factor` times as large: "give
/// materials.sand.young_modulus at least 24 MPa".
std::string stiffer_materials(const scenario::Setup& setup, const scenario::InteractionSpec& pair,
                              double factor);

/// What to write so that this impact overlaps by k_soft_overlap.
std::string stiffness_advice(const scenario::Setup& setup, const ImpactOverlap& impact);

/// Warns where grains are so soft at the expected speed that they overlap by more than
/// k_warned_overlap of their radius, with the stiffness to write.
void check_softness(const scenario::Setup& setup, const ParticleModels& models,
                    scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight

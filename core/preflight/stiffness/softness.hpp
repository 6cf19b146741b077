// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "preflight/places/fall.hpp"
#include "registry/registry.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <cstddef>
#include <string>

namespace dust::preflight {

/// The softest impact of a scenario: that of the largest overlap over the radius.
struct ImpactOverlap {
  double ratio = 0.0;            ///< [-] overlap / smaller radius; 0 without grains that move
  double diameter = 0.0;         ///< [m] of the grain, the smaller of two
  double speed = 0.0;            ///< [m/s] of the impact
  std::size_t interaction = 0;   ///< whose law it is, as Setup::interactions
  bool is_hertz = false;         ///< the elastic force is that of Hertz
  Fall fall = {};                ///< the largest of the scenario
  bool is_of_fall = false;       ///< `speed` is that at its end
  double steps = 0.0;            ///< [-] of the grain's own that it lasts; 0: not by Hertz
  double ratio_in_stream = 0.0;  ///< [-] as `ratio`, at the speed that the steps are made for
};

/// Above this overlap over the radius grains are soft, docs/result_files.md, "health": said in the
/// line of `engine check`. Many scenarios are so on purpose, for longer steps.
inline constexpr double k_soft_overlap = 0.05;
/// Above this one a scenario is warned of, be it at the end of a fall that something may break.
inline constexpr double k_warned_overlap = 0.3;

/// A fall that ends in fewer steps than these costs some per cent of its restitution.
inline constexpr double k_accurate_steps = 12.0;

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

/// The softest impact at the speed that the scenario expects. Where it says none, at that of its
/// steps or of the largest fall, whichever is faster: steps follow from approach speeds in a stream
/// and become hardly shorter at the end of a fall (as v^(-1/5)); overlaps grow (as v^(4/5)).
ImpactOverlap expected_impact(const scenario::Setup& setup, const ParticleModels& models,
                              const registry::Registry& registry);

/// "7.6 m/s, after a fall of 2.75 m": the speed of an impact, and where it comes from.
std::string impact_speed_text(const ImpactOverlap& impact);

/// What to write so that this impact overlaps by k_soft_overlap: "give materials.sand.young_modulus
/// at least 24 MPa".
std::string stiffness_advice(const scenario::Setup& setup, const ImpactOverlap& impact);

/// Warns where grains are so soft that they overlap by more than k_warned_overlap of their radius
/// in the expected impact, with the stiffness to write.
void check_softness(const scenario::Setup& setup, const ParticleModels& models,
                    const registry::Registry& registry, scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/liberation_law.hpp"
#include "preflight/particle_models.hpp"
#include "registry/registry.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <span>
#include <vector>

namespace dust::preflight {

/// Tells suction openings in whose box there is no part of the body's surface within the domain, or
/// an edge or a line of it alone: no fluid could leave there. What only the grid shows (other
/// bodies before it) the run tells.
void check_suctions(const scenario::Setup& setup, const ParticleModels& models,
                    scenario::Diagnostics& diagnostics);

/// Whether anything draws out what touches it: hoods, suction of bodies.
bool has_openings(const scenario::Setup& setup, const scenario::DustSetup& dust);

/// Warns of hoods and suction openings that draw out what an emitter has just let in: an error
/// where they take all of it. `first`: what each emitter proposes in its first steps.
void check_openings(const scenario::Setup& setup, const scenario::DustSetup& dust,
                    const ParticleModels& models,
                    std::span<const std::vector<sdk::InsertionRequest>> first,
                    scenario::Diagnostics& diagnostics);

/// Narrowest turn of the gas [m] that dust still follows: \f$ \tau U / 0.2 \f$
/// (airborne::k_largest_stokes_number) with the relaxation time \f$ \tau = \rho d^2 / (18 \mu) \f$.
double narrowest_turn(double diameter, double density, double viscosity, double speed);

/// Warns of classes of a dust field that do not follow the gas round turns that the grid resolves,
/// four cells wide, at the speed of bodies, emitters and what blows through sides (`air_speed`):
/// the drift by inertia is limited there. Nothing where the field has none.
void check_drift(const scenario::Setup& setup, const scenario::DustSetup& dust, double air_speed,
                 const ParticleModels& models, scenario::Diagnostics& diagnostics);

/// Warns of feeds that begin or end while the rates of dust off their loads are taken, from
/// `steady_after` or half of the run on: they give no amounts per load then. Not where a branch
/// begins its means in the middle of what is left of it: `is_branch`.
void check_feeds(const scenario::Setup& setup, const scenario::DustSetup& dust, bool is_branch,
                 const ParticleModels& models, scenario::Diagnostics& diagnostics);

/// Hints at `dust.feed_zones` where a load with dust rains onto a running belt grain by grain and
/// no zone is given: in the plant it lies there already. `first`: the grains that each emitter
/// proposes first.
void check_feed_zones(const scenario::Setup& setup, const scenario::DustSetup& dust,
                      const ParticleModels& models,
                      std::span<const std::vector<sdk::InsertionRequest>> first,
                      scenario::Diagnostics& diagnostics);

/// What a law of liberation is prepared with; the diameters stay those of `field`.
sdk::DustProperties dust_properties(const scenario::Setup& setup,
                                    const scenario::DustFieldSpec& field);

/// Prepares the law of liberation as the run will: one that does not fit the classes is told at its
/// place.
void check_liberation(const scenario::Setup& setup, const scenario::DustSetup& dust,
                      const registry::Registry& registry);

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/derived.hpp"

namespace dust::preflight {

/// Height [m] a grain can fall through.
double fall_height(const scenario::Setup& setup);

/// Estimates grains, memory, disk and time of a run from its steps, emissions and cells; writes the
/// last fields of `derived`. Time is told term by term, each an amount of work at a rate of its
/// own, so that what runs on this machine took can correct each (LearntCosts). Held against runs in
/// docs/validation/estimates.md. `begin` [s]: the state it starts from; what a run up to there
/// would have cost is taken off.
void estimate_cost(const scenario::Setup& setup, Derived& derived, double begin = 0.0);

/// Contacts between grains, per grain, in a load of `layers` diameters of solids that a body
/// carries: none where they lie side by side, those of a bed in a deep load.
double carried_contacts(double layers);

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/derived.hpp"

namespace dust::preflight {

/// Height [m] a grain can fall through.
double fall_height(const scenario::Setup& setup);

/// Estimates grains, memory, disk and time of a run from its steps, emissions and cells; writes the
/// last fields of `derived`. Meant to be within a factor of two for the shipped scenarios
/// (docs/validation/estimates.md). `body_speed` [m/s] carries the grains out, where there is one.
void estimate_cost(const scenario::Setup& setup, double body_speed, Derived& derived);

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/derived.hpp"
#include "registry/registry.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Places the grains that come at once, each emitter's among themselves, from `begin` [s] on: what
/// finds no place is refused as a run would refuse it. Of very many only a run finds out, and what
/// bodies take of a region.
void try_placing(const scenario::Setup& setup, const registry::Registry& registry,
                 const Derived& derived, double begin);

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/derived.hpp"
#include "registry/registry.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Warns of means that begin, by what the scenario says, before the stream has come through the
/// domain: those of sensors (`steady_after`, `averaging_after`) and of `dust`. Not of a run that
/// starts from another.
void check_steady(const scenario::Setup& setup, const scenario::DustSetup& dust,
                  const registry::Registry& registry, const Derived& derived,
                  scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "registry/registry.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Warns of sensors of surfaces that have none before them, whose figures would be zeros that look
/// like answers: `wear` without a wall in its box, `belt_load` over nothing, or along another way
/// than the belt below it runs. Bodies that move or are taken away may come there: they are asked
/// for where they stand at the beginning and at the end.
void check_sensor_surfaces(const scenario::Setup& setup, const bodies::BodySet& bodies,
                           const registry::Registry& registry, scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight

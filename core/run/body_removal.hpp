// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "particles/grain_rows.hpp"
#include "setup/setup.hpp"

#include <span>

namespace dust::run {

/// Takes away the bodies whose time has come or whose particles have come to rest, at `time` [s],
/// the beginning of a fluid step. Returns whether there was one.
bool remove_bodies(const scenario::Setup& setup, double time, const particles::GrainRows& rows,
                   bodies::BodySet& bodies);

/// [J] Translation and rotation, mean over the real particles; infinite without any.
[[nodiscard]] double kinetic_energy_per_grain(const particles::GrainRows& rows);

}  // namespace dust::run

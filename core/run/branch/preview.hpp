// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "run/summary/summary.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/reader.hpp"

#include <optional>

namespace dust::run {

/// What a scenario would start from, for `engine check`; nothing where it starts at 0 s or where
/// there is no such run yet. What is in the way goes to `diagnostics`.
std::optional<StartFacts> preview_start(const scenario::ReadResult& read,
                                        const registry::Registry& registry,
                                        scenario::Diagnostics& diagnostics);

}  // namespace dust::run

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/derived.hpp"
#include "registry/registry.hpp"
#include "setup/setup.hpp"

namespace dust::run {

/// Places the grains that come at once, from `begin` [s] on, as a run would: what finds no place,
/// lies outside the domain or overlaps another, a body or a wall is refused with the words of the
/// run. Of very many only a run finds out; of what comes later than 0 s, how it meets the grains
/// that are there by then, too.
void rehearse_placing(const scenario::Setup& setup, const registry::Registry& registry,
                      const preflight::Derived& derived, double begin);

}  // namespace dust::run

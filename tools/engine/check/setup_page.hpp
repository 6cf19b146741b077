// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <string>

namespace dust::engine {

/// The page of a set-up: bodies, emitters and sensors from the side and in three dimensions, sides,
/// and what the run will cost, `check` as `engine check --json` prints it.
std::string setup_page(const scenario::Setup& setup, const scenario::DustSetup& dust,
                       const registry::Registry& registry, const std::string& check);

}  // namespace dust::engine

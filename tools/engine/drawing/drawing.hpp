// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "setup/setup.hpp"

#include <string>

namespace dust::engine {

/// SVG of the set-up from the side, gravity pointing down: domain, outlines of the bodies, boxes of
/// emitters and sensors, a scale.
std::string draw_setup(const scenario::Setup& setup, const registry::Registry& registry);

}  // namespace dust::engine

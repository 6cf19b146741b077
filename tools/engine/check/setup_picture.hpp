// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/derived.hpp"
#include "registry/registry.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <string>

namespace dust::engine {

/// The set-up from the side as an SVG, for documents: domain with axes and a scale bar, bodies in
/// outline and cut in the middle, belts with the way they run, feeds, hoods and inlets, each with
/// its name. The page (setup_page.hpp) shows more.
std::string setup_picture(const scenario::Setup& setup, const scenario::DustSetup& dust,
                          const registry::Registry& registry, const preflight::Derived& derived);

/// What is wrong with a name for it; empty where nothing is. Files that are no such picture are not
/// overwritten.
std::string picture_name_problem(const std::string& name);

}  // namespace dust::engine

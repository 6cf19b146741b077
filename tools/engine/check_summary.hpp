// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/derived.hpp"
#include "setup/setup.hpp"

#include <string>

namespace dust::engine {

/// What a scenario will do, for a person to read before it is run.
std::string check_summary(const scenario::Setup& setup, const preflight::Derived& derived);

/// The numbers of it, for programs; times on one core.
std::string check_json(const scenario::Setup& setup, const preflight::Derived& derived);

}  // namespace dust::engine

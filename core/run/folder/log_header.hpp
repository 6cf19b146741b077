// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "run/run_options.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <string>
#include <vector>

namespace dust::run {

/// By what, where and from what a run is made: the first lines of run.log, so that it can be
/// repeated years later.
std::vector<std::string> log_header(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                    const registry::Registry& registry, const RunOptions& options,
                                    const std::string& scenario_sha256);

}  // namespace dust::run

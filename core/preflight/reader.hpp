// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "scenario/reader.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace dust::preflight {

/// Reads a scenario as scenario::read_file does and looks whether it can be run: steps that the
/// grains allow, flows through the sides that can be solved. Throws one UserError with all
/// problems. Nothing is written.
scenario::ReadResult read_scenario(const std::filesystem::path& file,
                                   const std::vector<scenario::Override>& overrides,
                                   const registry::Registry& registry,
                                   const std::vector<std::filesystem::path>& set_files = {});

/// As read_scenario for a tree at hand: its problems go to `diagnostics`, and nothing comes back
/// where there are errors. `file` names the scenario that has no name of its own.
std::optional<scenario::ReadResult> read_tree(const scenario::Node& root,
                                              const std::filesystem::path& file,
                                              const registry::Registry& registry,
                                              scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"

#include <filesystem>
#include <vector>

namespace dust::registry {

/// Opens a plugin library, compares its handshake and lets it register its models. The library
/// stays loaded. Throws base::PluginError, which names the file, for a library that cannot be used.
std::vector<Entry> load_library(const std::filesystem::path& file);

/// What is wrong with a model's description, one sentence per problem; empty if nothing is.
std::vector<std::string> description_problems(const sdk::ModelInfo& info);

}  // namespace dust::registry

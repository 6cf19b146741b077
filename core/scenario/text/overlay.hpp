// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/reader.hpp"
#include "scenario/text/tree.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dust::scenario {

/// Reads a file with everything it includes: the including file wins, key by key. Nothing where the
/// file itself cannot be read.
std::optional<Node> read_with_includes(const std::filesystem::path& file, Diagnostics& diagnostics);

/// Lays `over` over `base`: maps are merged key by key, everything else is replaced; `null` takes
/// away.
void merge(Node& base, Node over);

/// The same for two scenarios, where `interactions` are laid over each other pair by pair.
void merge_scenario(Node& base, Node over);

/// To do where a map gets another `model`: what it gave beside the one before may be that one's
/// alone and need not fit.
void take_model(Node& map, const std::string& model);

/// Sets the key at a dotted `path` of `root`, or takes it away; problems are told at `here`.
void set_path(Node& root, const std::string& path, Node value, const Mark& here,
              Diagnostics& diagnostics);

/// Sets one key of `root` from the command line.
void apply_override(Node& root, const Override& override, Diagnostics& diagnostics);

}  // namespace dust::scenario

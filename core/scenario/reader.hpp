// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "setup/dust_setup.hpp"
#include "setup/reference_curve.hpp"
#include "setup/reference_spec.hpp"
#include "setup/setup.hpp"
#include "setup/start_setup.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dust::scenario {

/// A `--set path=value`.
struct Override {
  std::string path;
  std::string value;
};

/// A scenario as it is written, with names and numbers checked.
struct ReadResult {
  Setup setup;
  DustSetup dust;
  StartSetup start;
  std::vector<ReferenceSpec> references;         ///< of enabled sensors
  std::vector<ReferenceCurve> reference_curves;  ///< of enabled sensors
  std::vector<std::string> documents;  ///< the scenario, what it includes and what is laid over it
  std::vector<std::string> files;      ///< that models read, as `resolved_yaml` names them
  std::string resolved_yaml;           ///< includes merged, overrides applied, defaults written out
  std::vector<std::string> warnings;   ///< "file:line:column: warning: ..."
};

/// The name of a scenario or study whose file gives none: a folder name that works everywhere, in
/// which other characters of the file's stem are '_'.
std::string name_from_file(const std::filesystem::path& file);

struct Node;
class Diagnostics;

/// Reads `file`, merges includes, lays `set_files` over it and applies `overrides`. Its problems go
/// to `diagnostics`, and nothing comes back where there are errors. Whether what is written can be
/// run, preflight/reader.hpp tells.
std::optional<ReadResult> read_file(const std::filesystem::path& file,
                                    const std::vector<Override>& overrides,
                                    const registry::Registry& registry,
                                    const std::vector<std::filesystem::path>& set_files,
                                    Diagnostics& diagnostics);

/// As read_file for a tree at hand. `file` names the scenario that has no name of its own.
std::optional<ReadResult> read_tree(const Node& root, const std::filesystem::path& file,
                                    const registry::Registry& registry, Diagnostics& diagnostics);

/// JSON Schema (draft-07) of scenarios with the plugins found.
std::string json_schema(const registry::Registry& registry);

}  // namespace dust::scenario

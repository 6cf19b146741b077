// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dust::io {

/// A file that a scenario reads: its content tells which one it is, not where it lies.
struct InputFile {
  std::string written;  ///< as the resolved scenario names it
  std::string sha256;   ///< of its content
  bool operator==(const InputFile&) const = default;
};

/// SHA-256 of what stands in a file; empty where it cannot be read.
std::string content_sha256(const std::filesystem::path& file);

/// A scenario as run, with what stood in the files that it reads.
struct ScenarioIdentity {
  std::string resolved_yaml;
  std::vector<InputFile> inputs;
};

/// What there is to say of a run that goes on from its checkpoint, and what it goes on with.
struct Resumption {
  std::vector<std::string> log_lines;  ///< for run.log: files that lie elsewhere now
  std::vector<std::string> warnings;   ///< what is no longer as it was, though not in the way
  std::vector<InputFile> inputs;       ///< as they are, but the state that the run began with
};

}  // namespace dust::io

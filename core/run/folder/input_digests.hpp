// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/input_files.hpp"
#include "scenario/reader.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dust::run {

/// The files and folders that a run of the scenario reads: what it is written in, files of models
/// and the run that it starts from.
std::vector<std::filesystem::path> read_paths(const scenario::ReadResult& read);

/// What stands in the files that scenarios read; each file is looked at once.
class InputDigests {
 public:
  /// The files of models, and the state that the run starts from where there is one.
  std::vector<io::InputFile> of(const scenario::ReadResult& read);

 private:
  const std::string& content_of(const std::filesystem::path& file);

  std::map<std::filesystem::path, std::string> known_;
};

}  // namespace dust::run

// SPDX-License-Identifier: Apache-2.0
#include "run/folder/input_digests.hpp"

#include "run/branch/origin.hpp"

#include <algorithm>

namespace dust::run {

std::vector<std::filesystem::path> read_paths(const scenario::ReadResult& read) {
  std::vector<std::filesystem::path> paths(read.documents.begin(), read.documents.end());
  paths.insert(paths.end(), read.files.begin(), read.files.end());
  if (read.start.from) paths.push_back(read.start.from->folder);
  return paths;
}

const std::string& InputDigests::content_of(const std::filesystem::path& file) {
  const auto [at, is_new] = known_.try_emplace(file);
  if (is_new) at->second = io::content_sha256(file);
  return at->second;
}

std::vector<io::InputFile> InputDigests::of(const scenario::ReadResult& read) {
  std::vector<io::InputFile> inputs;
  for (const std::string& file : read.files) {
    const io::InputFile input{file, content_of(file)};
    if (std::find(inputs.begin(), inputs.end(), input) == inputs.end()) inputs.push_back(input);
  }
  if (!read.start.from) return inputs;
  if (const auto state = state_file(*read.start.from)) {
    inputs.push_back({read.start.from->written, content_of(*state)});
  }
  return inputs;
}

}  // namespace dust::run

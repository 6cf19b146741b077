// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace dust::io {

/// A folder whose results are to make room for new ones.
struct Replaced {
  std::filesystem::path folder;
  std::span<const char* const> files;  ///< that go: names of files and folders in it
  std::string kind, mark;              ///< "run", and the file that folders of runs have
  std::string other, other_mark;       ///< "study", and the file that folders of studies have
};

/// Refuses to clear what is not of this kind, or what is still read: `inputs` are files and
/// folders. Throws base::UserError; removes nothing.
void check_replaced(const Replaced& replaced, const std::vector<std::filesystem::path>& inputs);

}  // namespace dust::io

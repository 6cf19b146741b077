// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/study.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dust::study {

/// The folder of a study: `results/NAME`, `-2`, `-3`, ... or what -o says. Throws base::UserError
/// where it holds something and neither --resume nor --force is given, or with --force something
/// that is no study, or one of the files and folders that the study reads, `inputs`. Makes and
/// changes nothing.
std::filesystem::path choose_study_folder(const StudyOptions& options, const std::string& name,
                                          const std::vector<std::filesystem::path>& inputs);

/// After the lock: throws base::UserError where another study that began at the same time has
/// written to a folder that was unused when it was chosen.
void check_still_unused(const StudyOptions& options, const std::filesystem::path& folder);

/// Removes what a study writes, and nothing else.
void clear_study_folder(const std::filesystem::path& folder);

/// Keeps a second program out of a study's folder. The runs inherit the lock: it is free again once
/// the last of them has ended, also when the study itself was killed.
class FolderLock {
 public:
  /// Waits a while for runs that are still writing their checkpoints, and says so at once; throws
  /// base::UserError when the folder stays busy.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace dust::study

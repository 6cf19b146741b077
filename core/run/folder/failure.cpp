// SPDX-License-Identifier: Apache-2.0
#include "run/folder/failure.hpp"

#include "base/log.hpp"
#include "base/process/shell_word.hpp"

namespace dust::run {
namespace {

namespace fs = std::filesystem;

/// Behind a file that could not be written.
std::string way_on(const fs::path& folder) {
  const std::string to_folder = " -o " + base::shell_word(folder.string());
  std::error_code none;
  if (fs::exists(folder / "checkpoint.h5", none)) {
    return ", then go on from the last good checkpoint with --resume" + to_folder;
  }
  if (fs::exists(folder, none)) return ", then start again with --force" + to_folder;
  return " Where it has been moved it holds the last good checkpoint: go on with --resume -o and "
         "its new place; else start again with" +
         to_folder;
}

}  // namespace

void log_failure(const fs::path& folder, const Failure& failure) {
  const std::string checkpoint = (folder / "checkpoint.h5").string();
  const std::string when = "the run failed at t = " + std::to_string(failure.time) + " s: ";
  if (failure.is_of_disk) {
    base::log_error(when + failure.reason + way_on(folder));
    return;
  }
  base::log_error(when + failure.reason);
  if (!fs::exists(checkpoint)) {
    base::log_error("there is no checkpoint: after mending the cause start again with --force -o " +
                    folder.string());
    return;
  }
  base::log_error("the last good checkpoint is " + checkpoint +
                  ": the same scenario goes on from it with --resume, a changed one (steps, "
                  "speeds, laws, bodies) with 'start_from: " +
                  folder.string() + "' (docs/how_to/branch_a_run.md)");
}

}  // namespace dust::run

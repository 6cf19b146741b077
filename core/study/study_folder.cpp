// SPDX-License-Identifier: Apache-2.0
#include "study/study_folder.hpp"

#include "base/error.hpp"
#include "io/replacing.hpp"
#include "io/result_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>
#include <utility>

namespace dust::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_study_files[] = {"study.yaml",  "study.csv", "study.h5", "calibration.json",
                                         "report.html", "points",    "slurm"};
/// A run ends within one fluid step of a signal; coarse scenarios take seconds for one.
constexpr auto k_longest_wait = std::chrono::seconds(30);

bool is_used(const fs::path& folder) {
  return fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder));
}

/// A name that is mistyped is not to begin the study anew.
void check_resumed(const StudyOptions& options, const fs::path& folder) {
  if (!options.resume || is_used(folder)) return;
  throw base::UserError(
      "error: " + folder.string() + " holds no study to resume; " +
      (options.output ? "start the study without --resume" : "name the study's folder with -o"));
}

fs::path named_or_numbered(const StudyOptions& options, const std::string& name) {
  if (options.output) {
    const fs::path& folder = *options.output;
    io::check_result_folder(folder);
    if (is_used(folder) && !options.resume && !options.force) {
      throw base::UserError("error: the folder " + folder.string() +
                            " is not empty; give --resume to go on with the study in it, --force "
                            "to replace it, or another -o");
    }
    check_resumed(options, folder);
    return folder;
  }
  const auto numbered = [&](int n) {
    return fs::path("results") / (n == 1 ? name : name + "-" + std::to_string(n));
  };
  int free = 1;
  while (fs::exists(numbered(free))) ++free;
  fs::path folder = numbered(options.resume || options.force ? std::max(1, free - 1) : free);
  io::check_result_folder(folder);
  check_resumed(options, folder);
  return folder;
}

}  // namespace

fs::path choose_study_folder(const StudyOptions& options, const std::string& name,
                             const std::vector<fs::path>& inputs) {
  const fs::path folder = named_or_numbered(options, name);
  if (options.force && !options.resume) {
    io::check_replaced({folder, k_study_files, "study", "study.lock", "run", "run.log"}, inputs);
  }
  return folder;
}

void check_still_unused(const StudyOptions& options, const fs::path& folder) {
  if (options.resume || options.force) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() == "study.lock") continue;
    throw base::UserError("error: another study has taken the folder " + folder.string() +
                          " meanwhile; start this one again, or give another -o");
  }
}

void clear_study_folder(const fs::path& folder) {
  for (const char* name : k_study_files) fs::remove_all(folder / name);
}

FolderLock::FolderLock(const fs::path& folder) {
  const std::string file = (folder / "study.lock").string();
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT, 0666);
  if (descriptor_ < 0) {
    throw base::UserError("error: cannot write " + file + ": " + std::strerror(errno));
  }
  const auto end = std::chrono::steady_clock::now() + k_longest_wait;
  bool is_reported = false;
  while (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    if (std::chrono::steady_clock::now() > end) {
      close(descriptor_);
      throw base::UserError("error: another study is running in " + folder.string() +
                            "; wait for it, or give another -o");
    }
    if (!std::exchange(is_reported, true)) {
      std::fprintf(stderr,
                   "%s is in use by another study, or by runs of one that was stopped and are "
                   "writing their checkpoints: waits up to %lld s for it\n",
                   folder.c_str(), static_cast<long long>(k_longest_wait.count()));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace dust::study

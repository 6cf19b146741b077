// SPDX-License-Identifier: Apache-2.0
#include "run/folder/output_folder.hpp"

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/write_error.hpp"
#include "io/replacing.hpp"
#include "io/result_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace dust::run {
namespace {

namespace fs = std::filesystem;

/// Everything a run writes; --force clears these and nothing else. run.log carries the lock and is
/// emptied by the log itself.
constexpr std::array k_run_files = {"scenario.yaml", "summary.json",     "series.csv",
                                    "results.h5",    "particles.xdmf",   "fluid.xdmf",
                                    "walls.xdmf",    "checkpoint.h5",    "report.html",
                                    "report.json",   "frames",           "series.csv-metadata.json",
                                    "checkpoints",   "paraview_state.py"};

fs::path numbered(const std::string& name, int n) {
  return fs::path("results") / (n == 1 ? name : name + "-" + std::to_string(n));
}

int first_free_number(const std::string& name) {
  int free = 1;
  while (fs::exists(numbered(name, free))) ++free;
  return free;
}

}  // namespace

OutputFolder::OutputFolder(const RunOptions& options, const std::string& scenario_name,
                           const std::vector<fs::path>& inputs)
    : name_(scenario_name),
      is_replaced_(options.force && !options.resume),
      must_be_unused_(!options.force && !options.resume) {
  if (options.output) {
    choose(options);
  } else {
    choose_numbered(options);
  }
  if (!is_replaced_) return;
  io::check_replaced({path_, k_run_files, "run", "run.log", "study", "study.lock"}, inputs);
}

void OutputFolder::choose(const RunOptions& options) {
  path_ = *options.output;
  io::check_result_folder(path_);
  const bool is_used = fs::exists(path_) && !fs::is_empty(path_);
  if (options.resume) {
    if (!fs::exists(path_ / "checkpoint.h5")) {
      throw base::UserError("error: " + path_.string() +
                            " holds no checkpoint.h5 to resume from; " +
                            (is_used ? "start again with --force in place of --resume"
                                     : "start the run without --resume"));
    }
  } else if (is_used && !options.force) {
    throw base::UserError("error: the folder " + path_.string() +
                          " is not empty; give --resume to go on with the run in it, --force to "
                          "replace it, or another -o");
  }
}

OutputFolder::~OutputFolder() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFolder::choose_numbered(const RunOptions& options) {
  const int free = first_free_number(name_);
  is_new_number_ = !options.resume && !(options.force && free > 1);
  path_ = numbered(name_, is_new_number_ ? free : std::max(1, free - 1));
  io::check_result_folder(path_);
  if (options.resume && !fs::exists(path_ / "checkpoint.h5")) {
    throw base::UserError("error: " + path_.string() +
                          " holds no checkpoint.h5 to resume from; name the run's folder with -o");
  }
}

void OutputFolder::open() {
  make();
  lock();
  if (must_be_unused_) check_still_unused();
  if (!is_replaced_) return;
  for (const char* file : k_run_files) {
    std::error_code problem;
    fs::remove_all(path_ / file, problem);
    if (problem) throw base::WriteError(path_ / file, problem.value());
  }
}

void OutputFolder::make() {
  if (!is_new_number_) return io::make_result_folder(path_);
  io::make_result_folder(path_.parent_path());
  std::error_code problem;
  // Another run may have taken the number while this one was read.
  while (!fs::create_directory(path_, problem) && !problem) {
    path_ = numbered(name_, first_free_number(name_));
  }
  if (problem) throw base::WriteError(path_, problem.value());
}

void OutputFolder::lock() {
  const fs::path file = path_ / "run.log";
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw base::WriteError(file, errno);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK) {
    throw base::UserError("error: another engine is writing to " + path_.string() +
                          "; wait for its end or stop it (" + file.string() +
                          " names its process), or give another -o");
  }
  base::log_warning(path_.string() +
                    " cannot be locked on this file system: see to it that no other run writes "
                    "to it");
}

void OutputFolder::check_still_unused() const {
  const bool is_used =
      std::any_of(fs::directory_iterator(path_), fs::directory_iterator(),
                  [](const fs::directory_entry& entry) {
                    return entry.path().filename() != "run.log" || entry.file_size() > 0;
                  });
  if (!is_used) return;
  throw base::UserError("error: another run has taken the folder " + path_.string() +
                        " meanwhile; give --resume to go on with the run in it, --force to replace "
                        "it, or another -o");
}

}  // namespace dust::run

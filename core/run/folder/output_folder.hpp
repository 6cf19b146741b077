// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/run_options.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dust::run {

/// The folder that a run writes to: chosen by -o, --force and --resume, then held for this process
/// alone. Two runs that write to one folder would leave files of which neither is whole.
class OutputFolder {
 public:
  /// Writes nothing; throws base::UserError where the options do not fit what is there, or what is
  /// to be replaced is no run's or among the files and folders that the run reads, `inputs`.
  OutputFolder(const RunOptions& options, const std::string& scenario_name,
               const std::vector<std::filesystem::path>& inputs);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Makes the folder if it is new and locks it; with --force the files of the run before go.
  /// Throws base::UserError when another process holds it or has written to it since it was chosen
  /// as unused, base::WriteError when it cannot be made.
  void open();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  void choose(const RunOptions& options);
  void choose_numbered(const RunOptions& options);
  void make();
  void lock();
  /// Large scenarios take minutes from the choice of the folder to here.
  void check_still_unused() const;

  std::string name_;  ///< of the scenario
  std::filesystem::path path_;
  bool is_new_number_ = false;  ///< results/NAME-2 and so on: the next one where it is taken
  bool is_replaced_ = false;    ///< --force
  bool must_be_unused_ = true;  ///< neither --force nor --resume
  int descriptor_ = -1;         ///< of the file that carries the lock
};

}  // namespace dust::run

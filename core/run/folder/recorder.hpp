// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/run_files.hpp"
#include "run/audit/force_shares.hpp"
#include "run/branch/used_models.hpp"
#include "run/run_times.hpp"
#include "run/simulation.hpp"
#include "run/summary/summary.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace dust::run {

/// Fluid steps from one thing that is written to the next.
struct Intervals {
  Intervals(const scenario::TimeSpec& time, double keep_every);

  std::int64_t frame;
  std::int64_t checkpoint;
  std::int64_t row;
  std::int64_t kept;  ///< checkpoint that stays; 0: none does

  [[nodiscard]] bool is_kept(std::int64_t done) const { return kept > 0 && done % kept == 0; }
};

/// The files of one run while it goes on: frames, rows, and checkpoints from which it can go on
/// with the same bits. All throw base::WriteError where a file cannot be written.
class Recorder {
 public:
  /// Keeps the simulation by reference; writes nothing.
  Recorder(Simulation& simulation, std::filesystem::path folder, io::ScenarioIdentity scenario,
           std::vector<UsedModel> models, double keep_every);

  /// Reads the folder's checkpoint into the simulation, to go on behind it. Throws base::UserError
  /// where it is of another scenario or of other models.
  io::Resumption resume();
  [[nodiscard]] bool is_resumed() const { return is_resumed_; }

  /// Of a run that is resumed: what cannot be gone on with is refused before anything is changed;
  /// then what was written when it had ended goes, for one that is killed now has not ended.
  void open();
  void close() { results_.reset(); }

  void write_scenario() const;
  void write_frame();
  /// Of the beginning, with the columns' metadata.
  void write_first_row(const RunFacts& facts);
  void write_row();
  void checkpoint(const RunFacts& facts);
  /// What is due after `done` fluid steps; of a checkpoint, but for the one at the end.
  [[nodiscard]] bool is_row_due(std::int64_t done) const { return done % every_.row == 0; }
  [[nodiscard]] bool is_frame_due(std::int64_t done) const { return done % every_.frame == 0; }
  [[nodiscard]] bool is_checkpoint_due(std::int64_t done) const {
    return done % every_.checkpoint == 0 || every_.is_kept(done);
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const std::vector<UsedModel>& models() const { return models_; }
  [[nodiscard]] const ForceShares& forces() const { return forces_; }
  [[nodiscard]] RunTimes& times() { return times_; }
  /// Times, frames and forces so far into `facts`.
  void note_progress(RunFacts& facts) const;

 private:
  void drop_end() const;

  Simulation& simulation_;
  std::filesystem::path folder_;
  io::ScenarioIdentity scenario_;
  std::vector<UsedModel> models_;
  Intervals every_;
  bool is_resumed_ = false;
  std::int64_t frames_ = 0;
  std::int64_t rows_ = 0;
  ForceShares forces_;
  RunTimes times_;
  std::unique_ptr<io::ResultsFile> results_;
  std::unique_ptr<io::SeriesFile> series_;
};

}  // namespace dust::run

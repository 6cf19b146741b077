// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "run/folder/recorder.hpp"
#include "run/progress/live_report.hpp"
#include "run/progress/progress.hpp"
#include "run/simulation.hpp"
#include "run/summary/summary.hpp"
#include "scenario/reader.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dust::run {

/// What helps where a checkpoint cannot be gone on with.
inline constexpr const char* k_restart_remedy = "start again with --force";

/// On the terminal, in run.log and in summary.json.
void warn(const std::string& text, RunFacts& facts);

/// Steps a simulation to its end and has written what is due on the way. A file that cannot be
/// written, or a model that fails, ends the run with its summary and the last good checkpoint.
class RunLoop {
 public:
  /// Keeps both by reference.
  RunLoop(Simulation& simulation, Recorder& recorder)
      : simulation_(simulation), recorder_(recorder) {}

  /// Goes on behind the checkpoint of the recorder's folder. Puts what it knows of its past into
  /// `facts`. Throws base::UserError where time.end has passed.
  void resume(const scenario::StartSetup& start, RunFacts& facts);

  /// The exit status of the program. `live` may be null.
  int execute(RunFacts facts, Progress& progress, LiveReport* live);

 private:
  void refuse_past_end(const scenario::Mark& end_where) const;
  void open_files();
  void loop(Progress& progress);
  void write_frame();
  void log_state() const;
  void publish_live();
  /// Does `work`; false when a file could not be written, which ends the run.
  template <class Work>
  bool survives_writing(Work&& work);
  /// The same, where whatever else goes wrong ends the run too.
  template <class Work>
  bool survives(Work&& work);
  void note_failure(const char* reason);
  void end_files();
  int close();
  void write_report() const;
  void learn_cost() const;

  Simulation& simulation_;
  Recorder& recorder_;
  bool is_disk_bad_ = false;  ///< a file could not be written
  RunFacts facts_;
  LiveReport* live_ = nullptr;
};

}  // namespace dust::run

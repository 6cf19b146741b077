// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/bulletin.hpp"
#include "live/server.hpp"
#include "run/progress/progress.hpp"
#include "run/simulation.hpp"
#include "run/summary/summary.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace dust::run {

/// The growing report of a run for browsers of this machine (`engine run --live`). It reads the
/// simulation between its steps and changes nothing of it.
class LiveReport {
 public:
  /// Takes the port; 0 takes any free one. Throws base::UserError where that is not possible.
  explicit LiveReport(int port) : server_(port) {}
  /// Begins to serve the run in `folder`.
  void begin(const std::filesystem::path& folder);

  [[nodiscard]] std::string address() const;
  /// After a frame.
  void publish_state(const Simulation& simulation, const RunFacts& facts);
  /// After a step, or at the end; at most twice a second but for another status.
  void publish_progress(const Simulation& simulation, const RunFacts& facts, const Pace& pace);

 private:
  std::unique_ptr<live::Bulletin> bulletin_;
  live::Server server_;  ///< ends before the bulletin it answers out of
  std::filesystem::path folder_;
  Pace::Clock::time_point last_;
  std::string last_status_;
};

}  // namespace dust::run

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/run_cost.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dust::preflight {

/// Processor time of a fixed piece of work over that of the machine the estimates were made on;
/// takes some hundredths of a second.
double measured_slowness();

/// What is wrong with the memory that a run needs beside what is free now; "" where it fits, or
/// nobody knows what is free.
std::string memory_shortage(const RunCost& expected);

/// What runs on this machine were told to cost and what they took, term by term, kept in the user's
/// cache folder.
///
/// Runs of the same scenario tell how much dearer each term becomes in all: more work than was told
/// as well as slower work. The more alike they are in what they were told to take, the more they
/// count: the first moments of a stream that has not arrived yet say little of all of it. Those of
/// other scenarios tell the rate alone, seconds per amount of
/// work, for how much work there is was told for other grains. Where no run has had enough of a
/// term, its rate is that of a short measurement.
class LearntCosts {
 public:
  /// An estimate that runs have corrected.
  struct Expected {
    RunCost cost;
    int runs = 0;                 ///< it rests on; 0 = a short measurement of the machine
    bool is_of_scenario = false;  ///< of the same name, not of others
  };

  /// $XDG_CACHE_HOME/dust/costs_by_term, or ~/.cache/dust/costs_by_term; empty where there is no
  /// such folder.
  static std::filesystem::path default_file();
  /// Reads `file` if it is there; what cannot be read is left out.
  explicit LearntCosts(std::filesystem::path file = default_file(),
                       std::function<double()> slowness = measured_slowness);

  [[nodiscard]] Expected expect(const std::string& scenario, const RunCost& estimated) const;
  /// Adds a finished run and writes the file. Nobody is told where that is impossible: it is a
  /// cache.
  void add(const std::string& scenario, const RunCost& estimated, const RunCost& taken);

 private:
  struct Run {
    std::string scenario;
    RunCost estimated, taken;
  };
  /// Of `scenario`, those most like a run of `seconds` of estimated time; the newest first among
  /// those that are about as like it.
  [[nodiscard]] std::vector<const Run*> most_alike(const std::string& scenario,
                                                   double seconds) const;
  [[nodiscard]] static Expected from_same(const std::vector<const Run*>& runs,
                                          const RunCost& estimated);
  [[nodiscard]] Expected from_others(const RunCost& estimated) const;
  /// In place of what is known.
  void read();
  void write() const;

  std::filesystem::path file_;
  std::function<double()> slowness_;
  std::vector<Run> runs_;  ///< the newest last
};

}  // namespace dust::preflight

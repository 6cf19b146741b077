// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dust::preflight {

/// How much longer or shorter runs on this machine took than they were estimated, kept in the
/// user's cache folder. An estimate knows neither the machine nor what a scenario's grains do all
/// day; the last runs do.
class LearntCosts {
 public:
  /// Of processor time to estimate.
  struct Factor {
    double value = 1.0;
    int runs = 0;                 ///< it rests on; 0 = a short measurement of the machine
    bool is_of_scenario = false;  ///< of the same name, not of others
  };

  /// $XDG_CACHE_HOME/dust/costs, or ~/.cache/dust/costs; empty where there is no such folder.
  static std::filesystem::path default_file();
  /// Reads `file` if it is there; what cannot be read is left out.
  explicit LearntCosts(std::filesystem::path file = default_file());

  [[nodiscard]] Factor factor_for(const std::string& scenario) const;
  /// Adds a finished run and writes the file. Nobody is told where that is impossible: it is a
  /// cache.
  void add(const std::string& scenario, double estimated_seconds, double processor_seconds);

 private:
  struct Run {
    std::string scenario;
    double factor = 1.0;
  };
  std::filesystem::path file_;
  std::vector<Run> runs_;  ///< the newest last
};

/// Processor time of a fixed piece of work over that of the machine the estimates were made on;
/// takes some hundredths of a second.
double measured_slowness();

}  // namespace dust::preflight

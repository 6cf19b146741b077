// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"

#include <chrono>
#include <vector>

namespace dust::run {

/// Processor time of this process [s].
[[nodiscard]] double cpu_seconds();

/// What a run has cost in time, over all its resumes.
class RunTimes {
 public:
  using Clock = std::chrono::steady_clock;

  /// From here on it counts.
  void start();
  /// Adds the time since `begin` to that of writing files.
  void add_output(Clock::time_point begin);

  [[nodiscard]] double wall() const;                         ///< [s]
  [[nodiscard]] double cpu() const;                          ///< [s]
  [[nodiscard]] double output() const { return output_s_; }  ///< [s]
  /// Seconds in each node of the graphs before the last resume.
  [[nodiscard]] const std::vector<double>& nodes_before() const { return nodes_before_; }

  /// `nodes`: seconds in each node by now.
  void save(sdk::ArchiveWriter& archive, const std::vector<double>& nodes) const;
  void load(sdk::ArchiveReader& archive);

 private:
  double wall_before_ = 0.0;
  double cpu_before_ = 0.0;
  double cpu_start_ = 0.0;
  double output_s_ = 0.0;
  std::vector<double> nodes_before_;
  Clock::time_point start_;
};

}  // namespace dust::run

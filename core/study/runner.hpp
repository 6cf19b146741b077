// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/launchers/launcher.hpp"
#include "study/table.hpp"

#include <chrono>

namespace dust::study {

/// Runs what is missing of a plan, keeps the table up to date and tells of every point that ends.
class Runner {
 public:
  struct Settings {
    bool fail_fast = false;
    bool quiet = false;
    std::size_t expected_points = 0;  ///< more than the plan has now while a calibration goes on
  };
  Runner(Plan& plan, const PointStore& store, Launcher& launcher, Settings settings);

  /// Reads what is there already; points that the plan gained since are waiting.
  void load_finished();
  /// Runs the waiting points and, once more, those that failed before this program was started.
  /// Returns the signal that interrupted it, or 0.
  int run();
  void write_table() const;

  [[nodiscard]] const Results& results() const { return results_; }
  [[nodiscard]] std::size_t failures() const;
  [[nodiscard]] bool was_stopped() const { return was_stopped_; }

 private:
  void print(std::size_t point);
  [[nodiscard]] std::string remaining() const;
  [[nodiscard]] std::string described(std::size_t point) const;

  Plan& plan_;
  const PointStore& store_;
  Launcher& launcher_;
  Settings settings_;
  Results results_;
  std::vector<bool> has_run_;  ///< in this program
  std::size_t ended_ = 0;
  double estimate_done_ = 0.0;  ///< [s] of core time, of what ran here
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool was_stopped_ = false;
};

/// Four significant digits.
std::string short_number(double value);

}  // namespace dust::study

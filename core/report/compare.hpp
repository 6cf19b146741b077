// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/page.hpp"
#include "report/run_text.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dust::report {

/// A key of the scenario that the runs do not share; "" where a run has none.
struct ScenarioDifference {
  std::string path, first, second;
};

/// A quantity that at least one run has; NaN where a run has none in this unit.
struct QuantityPair {
  std::string group;  ///< the sensor, or "run"
  std::string name;
  std::string unit;
  double first = 0.0, first_error = -1.0;  ///< errors: one standard error, negative: none given
  double second = 0.0, second_error = -1.0;
  std::string first_reason, second_reason;  ///< why there is no error: "not steady"; "" = not said

  [[nodiscard]] double difference() const { return second - first; }
  /// The difference in its own standard errors (independent runs: errors add in squares); NaN where
  /// neither run gives an error.
  [[nodiscard]] double in_errors() const;
};

/// Two runs side by side.
struct Comparison {
  std::string first_name, second_name;
  RunText first, second;
  std::vector<ScenarioDifference> scenario;
  std::vector<QuantityPair> headline;    ///< what a reader asks for first
  std::vector<QuantityPair> quantities;  ///< every figure of every sensor and of dust
  bool is_same_state = false;            ///< the end states agree bit for bit
};

/// The keys in which two scenarios differ, by dotted path; lists of plain values count as one.
/// Scenarios that cannot be read differ in nothing.
[[nodiscard]] std::vector<ScenarioDifference> scenario_differences(const std::string& first,
                                                                   const std::string& second);

/// Reads both runs. Throws base::UserError when one of the folders is no run.
[[nodiscard]] Comparison compare_runs(const std::filesystem::path& first,
                                      const std::filesystem::path& second);

/// A short table for a terminal.
[[nodiscard]] std::string comparison_text(const Comparison& comparison);

/// Writes one self-contained page: scenarios, quantities, plots over each other, pictures side by
/// side.
void write_comparison(const Comparison& comparison, const std::filesystem::path& first,
                      const std::filesystem::path& second, const std::filesystem::path& target,
                      const Templates& templates = Templates());

/// What the errors of two runs leave out.
inline constexpr const char* k_errors_of_one_run =
    "Errors are those of each run's own means in time. What chance does before them, as how a heap "
    "happens to be packed, is in none: of runs that differ by the seed alone some figures differ "
    "by more. A study of both with `replicates: 5` tells how much (engine study).";

/// All that the page of a comparison shows.
[[nodiscard]] nlohmann::json comparison_document(const Comparison& comparison,
                                                 const std::filesystem::path& first,
                                                 const std::filesystem::path& second);

}  // namespace dust::report

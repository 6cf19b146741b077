// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/plan.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dust::study {

enum class Status { waiting, finished, failed };

/// Why a figure that has not settled has no error, as summary.json says it.
constexpr const char* k_not_steady = "not steady";

/// A measured value; nothing where the run did not tell it, or says that there is none.
struct OutputValue {
  std::optional<double> value;
  double error = -1.0;  ///< one standard error, negative: none
  /// Why there is none, or no value: "few grains", "nothing passed"; "" = not said.
  std::string no_error = {};
};

/// What is known of a point.
struct Outcome {
  Status status = Status::waiting;
  std::string reason;  ///< of a failure, one line
  double wall_s = 0.0;
  std::vector<OutputValue> outputs;  ///< one per column, empty unless finished
};

/// The folder of a study: `points/HASH.yaml` is what a point runs, `points/HASH/` what it leaves,
/// `points/HASH.log` what it said, `points/HASH.failed` why it failed. These files are the study's
/// whole memory: whatever is killed, what had finished is found again.
class PointStore {
 public:
  explicit PointStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path scenario_of(const Point& point) const;
  [[nodiscard]] std::filesystem::path results_of(const Point& point) const;
  [[nodiscard]] std::filesystem::path log_of(const Point& point) const;

  /// Writes what the point runs, if it does not stand there so.
  void prepare(const Point& point) const;
  [[nodiscard]] bool has_checkpoint(const Point& point) const;

  [[nodiscard]] Outcome read(const Point& point, const std::vector<OutputColumn>& outputs) const;

  /// Notes that the point failed; the reason is the run's own, or `fallback`.
  void note_failure(const Point& point, const std::string& fallback) const;
  void discard_failure(const Point& point) const;

 private:
  [[nodiscard]] std::filesystem::path failure_of(const Point& point) const;
  std::filesystem::path folder_;
};

/// The last problem that a log tells, one line; "" for none.
std::string last_problem(const std::filesystem::path& log);

}  // namespace dust::study

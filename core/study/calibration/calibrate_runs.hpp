// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/runner.hpp"
#include "study/study_report.hpp"

#include <filesystem>

namespace dust::study {

/// The question of a calibration, with the units its columns have.
CalibrationSettings settings_of(const Spec& spec, const Plan& plan);

/// The mean of what replicates of a place tell; its error from theirs, if all tell one, else why
/// not.
OutputValue mean_of_replicates(const std::vector<OutputValue>& replicates);

/// Answers by running points: appends them to the plan of `runner` and has them run.
class RunEvaluator final : public Evaluator {
 public:
  RunEvaluator(const Spec& spec, Planner& planner, Plan& plan, Runner& runner)
      : spec_(spec), planner_(planner), plan_(plan), runner_(runner) {}
  std::optional<std::vector<Evaluation>> evaluate(
      const std::vector<std::vector<double>>& places) override;
  /// That interrupted it, or 0.
  [[nodiscard]] int signal() const { return signal_; }

 private:
  const Spec& spec_;
  Planner& planner_;
  Plan& plan_;
  Runner& runner_;
  int signal_ = 0;
};

/// calibration.json: estimates, correlation, targets and statements; replaced atomically.
void write_calibration(const std::filesystem::path& file, const CalibrationAnswer& answer);

}  // namespace dust::study

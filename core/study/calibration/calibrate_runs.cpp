// SPDX-License-Identifier: Apache-2.0
#include "study/calibration/calibrate_runs.hpp"

#include "io/atomic_file.hpp"
#include "study/noise.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace dust::study {

CalibrationSettings settings_of(const Spec& spec, const Plan& plan) {
  const CalibrationSpec& c = *spec.calibration;
  CalibrationSettings settings;
  for (const Target& t : c.targets) {
    const auto column =
        std::find_if(plan.outputs.begin(), plan.outputs.end(),
                     [&](const OutputColumn& o) { return o.name == t.measure.name; });
    settings.goals.push_back({t.measure.name, column->unit, t.value, t.error});
  }
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const FreeParameter& p = c.parameters[k];
    settings.parameters.push_back({p.name, plan.inputs[k].unit, p.low, p.high});
  }
  settings.surrogate = c.surrogate;
  settings.runs = static_cast<std::size_t>(c.runs);
  settings.first_runs = static_cast<std::size_t>(c.first_runs);
  settings.batch = static_cast<std::size_t>(c.batch);
  settings.confidence = c.confidence;
  return settings;
}

OutputValue mean_of_replicates(const std::vector<OutputValue>& replicates) {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  OutputValue mean;
  bool is_reported = true;
  for (const OutputValue& r : replicates) {
    if (!r.value) continue;
    sum += *r.value;
    count += 1.0;
    if (r.error >= 0.0) {
      squares += r.error * r.error;
      continue;
    }
    is_reported = false;
    // One that has not settled spoils the mean, whatever the others lack.
    if (mean.no_error.empty() || is_unsteady(r)) mean.no_error = r.no_error;
  }
  if (count == 0.0) return {};
  mean.value = sum / count;
  if (is_reported) mean.error = std::sqrt(squares) / count;
  return mean;
}

std::optional<std::vector<Evaluation>> RunEvaluator::evaluate(
    const std::vector<std::vector<double>>& places) {
  const std::size_t first = plan_.points.size();
  for (const auto& place : places) {
    for (Point& point : planner_.calibration_points(place))
      plan_.points.push_back(std::move(point));
  }
  signal_ = runner_.run();
  if (signal_ != 0 || runner_.was_stopped()) return std::nullopt;
  std::vector<Evaluation> evaluations;
  const auto replicates = static_cast<std::size_t>(spec_.replicates);
  const std::size_t goals = spec_.calibration->targets.size();
  for (std::size_t n = 0; n < places.size(); ++n) {
    Evaluation mean(goals);
    for (std::size_t g = 0; g < goals; ++g) {
      std::vector<OutputValue> values;
      for (std::size_t r = 0; r < replicates; ++r) {
        // The targets are the first measures, in their order.
        const Outcome& o = runner_.results().outcomes[first + n * replicates + r];
        if (g < o.outputs.size()) values.push_back(o.outputs[g]);
      }
      mean[g] = mean_of_replicates(values);
    }
    evaluations.push_back(std::move(mean));
  }
  return evaluations;
}

void write_calibration(const std::filesystem::path& file, const CalibrationAnswer& answer) {
  using Json = nlohmann::ordered_json;
  const Calibration& c = answer.calibration;
  Json json = {{"is_met", c.is_met},
               {"is_pinned", c.is_pinned},
               {"is_steady", is_steady(c)},
               {"misfit", c.misfit},
               {"confidence", answer.settings.confidence},
               {"runs", c.places.size()},
               {"statements", c.statements}};
  json["parameters"] = Json::object();
  for (std::size_t d = 0; d < c.estimates.size(); ++d) {
    const Freedom& p = answer.settings.parameters[d];
    const Estimate& e = c.estimates[d];
    json["parameters"][p.name] = {{"unit", p.unit},
                                  {"best", e.best},
                                  {"mean", e.mean},
                                  {"deviation", e.deviation},
                                  {"region", {e.low, e.high}},
                                  {"is_pinned", e.is_pinned}};
  }
  json["correlation"] = c.correlation;
  json["targets"] = Json::object();
  for (std::size_t g = 0; g < c.at_best.size(); ++g) {
    const Goal& goal = answer.settings.goals[g];
    const RunErrors& runs = c.run_errors[g];
    json["targets"][goal.name] = {
        {"unit", goal.unit},
        {"value", goal.value},
        {"error", goal.error},
        {"at_best", c.at_best[g].mean},
        {"surrogate_error", std::sqrt(c.at_best[g].variance)},
        {"scatter", c.scatter[g]},
        {"chi", chi_of(goal, c.at_best[g])},
        {"run_error", runs.error < 0.0 ? Json(nullptr) : Json(runs.error)},
        {"points_without_error", runs.without},
        {"points_not_steady", runs.unsteady}};
  }
  io::write_text(file, json.dump(2) + "\n");
}

}  // namespace dust::study

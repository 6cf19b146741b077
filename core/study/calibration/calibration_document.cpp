// SPDX-License-Identifier: Apache-2.0
#include "study/study_report.hpp"

#include <algorithm>
#include <cmath>

namespace dust::study {
namespace {

using Json = nlohmann::json;

/// Two parameters: what the surrogates say of every target on the grid of the landscape, where the
/// likeliest values are and how far the confidence region reaches.
Json crossing_json(const CalibrationAnswer& a) {
  const Landscape& l = a.calibration.landscape;
  Json axes = Json::array();
  for (std::size_t d = 0; d < 2; ++d) {
    const Freedom& p = a.settings.parameters[d];
    axes.push_back({{"name", p.name},
                    {"unit", p.unit},
                    {"low", p.low},
                    {"high", p.high},
                    {"best", a.calibration.estimates[d].best}});
  }
  Json fields = Json::array();
  for (std::size_t g = 0; g < l.predictions.size(); ++g) {
    Json means = Json::array();
    for (const Prediction& p : l.predictions[g]) means.push_back(p.mean);
    const Goal& goal = a.settings.goals[g];
    fields.push_back({{"name", goal.name},
                      {"unit", goal.unit},
                      {"level", goal.value},
                      {"error", goal.error},
                      {"values", means}});
  }
  Json points = Json::array();
  for (const auto& place : a.calibration.places) points.push_back({place[0], place[1]});
  return {{"axes", axes},
          {"per_direction", l.per_direction},
          {"fields", fields},
          {"region", {{"values", l.minus_log}, {"level", l.region_level}}},
          {"points", points}};
}

/// One parameter: what the surrogate says of every target, with the runs and the target.
Json curves_json(const CalibrationAnswer& a) {
  const Landscape& l = a.calibration.landscape;
  const Freedom& p = a.settings.parameters[0];
  Json plots = Json::array();
  for (std::size_t g = 0; g < a.settings.goals.size(); ++g) {
    const Goal& goal = a.settings.goals[g];
    Json line = {{"x", Json::array()}, {"y", Json::array()}};
    for (std::size_t n = 0; n < l.places.size(); ++n) {
      line["x"].push_back(p.low + l.places[n][0] * (p.high - p.low));
      line["y"].push_back(l.predictions[g][n].mean);
    }
    std::vector<std::pair<double, double>> runs;
    for (std::size_t n = 0; n < a.calibration.places.size(); ++n) {
      const auto& value = a.calibration.evaluations[n][g].value;
      if (value) runs.emplace_back(a.calibration.places[n][0], *value);
    }
    std::sort(runs.begin(), runs.end());
    Json marks = {{"x", Json::array()}, {"y", Json::array()}};
    for (const auto& [x, y] : runs) {
      // A plot needs one value per place.
      if (!marks["x"].empty() && marks["x"].back() == x) continue;
      marks["x"].push_back(x);
      marks["y"].push_back(y);
    }
    plots.push_back({{"parameter", p.name},
                     {"parameter_unit", p.unit},
                     {"low", p.low},
                     {"high", p.high},
                     {"goal", goal.name},
                     {"unit", goal.unit},
                     {"value", goal.value},
                     {"surrogate", line},
                     {"runs", marks}});
  }
  return plots;
}

Json estimates_json(const CalibrationAnswer& a) {
  Json list = Json::array();
  for (std::size_t d = 0; d < a.settings.parameters.size(); ++d) {
    const Freedom& p = a.settings.parameters[d];
    const Estimate& e = a.calibration.estimates[d];
    list.push_back({{"name", p.name},
                    {"unit", p.unit},
                    {"best", e.best},
                    {"mean", e.mean},
                    {"deviation", e.deviation},
                    {"low", e.low},
                    {"high", e.high},
                    {"is_pinned", e.is_pinned}});
  }
  return list;
}

Json targets_json(const CalibrationAnswer& a) {
  Json list = Json::array();
  for (std::size_t g = 0; g < a.settings.goals.size(); ++g) {
    const Goal& goal = a.settings.goals[g];
    const Prediction& p = a.calibration.at_best[g];
    const RunErrors& runs = a.calibration.run_errors[g];
    list.push_back({{"name", goal.name},
                    {"unit", goal.unit},
                    {"measured", goal.value},
                    {"measured_error", goal.error},
                    {"expected", p.mean},
                    {"expected_error", std::sqrt(p.variance)},
                    {"scatter", a.calibration.scatter[g]},
                    {"chi", chi_of(goal, p)},
                    {"run_error", runs.error < 0.0 ? Json(nullptr) : Json(runs.error)},
                    {"points_without_error", runs.without},
                    {"points_not_steady", runs.unsteady}});
  }
  return list;
}

}  // namespace

Json calibration_json(const CalibrationAnswer& a) {
  const bool has_answer = !a.calibration.estimates.empty();
  Json json = {{"has_answer", has_answer},
               {"places", a.calibration.places.size()},
               {"runs", a.settings.runs},
               {"surrogate", a.settings.surrogate},
               {"confidence", a.settings.confidence}};
  if (!has_answer) return json;
  json["is_good"] = a.calibration.is_met && a.calibration.is_pinned && is_steady(a.calibration);
  json["statements"] = Json::array();
  for (const std::string& text : a.calibration.statements) {
    json["statements"].push_back(with_true_signs(text));
  }
  json["estimates"] = estimates_json(a);
  json["targets"] = targets_json(a);
  if (a.settings.parameters.size() == 1) json["curves"] = curves_json(a);
  if (a.settings.parameters.size() == 2) json["crossing"] = crossing_json(a);
  return json;
}

}  // namespace dust::study

// SPDX-License-Identifier: Apache-2.0
#include "study/hoods/hood_results.hpp"

#include <algorithm>

namespace dust::study {
namespace {

using Json = nlohmann::json;

/// The fraction of the dust that the page asks of a hood: the default of `engine suggest-hoods`.
constexpr double k_wanted = 0.9;

Json estimate_json(const Uncertain& estimate, double factor) {
  return {{"value", factor * estimate.value},
          {"error", estimate.error > 0.0 ? Json(factor * estimate.error) : Json(nullptr)}};
}

Json trial_json(const HoodTrial& trial, const HoodScale& scale) {
  const double factor = scale.factor(trial);
  const auto capture = trial.capture();
  const bool is_few = trial.computed >= 0.0 && trial.computed < k_few_drawn;
  return {{"flow_m3_per_s", trial.flow},
          {"drawn", estimate_json(trial.drawn, factor)},
          {"drawn_by_others", estimate_json(trial.drawn_by_others, factor)},
          {"escapes", estimate_json(trial.escaping, factor)},
          {"capture", capture ? estimate_json(*capture, 1.0) : Json(nullptr)},
          {"is_few", is_few}};
}

}  // namespace

bool HoodResults::has_others() const {
  const auto draws = [](const HoodTrial& trial) { return trial.drawn_by_others.value > 0.0; };
  return (plain && draws(*plain)) || std::any_of(places.begin(), places.end(), [&](const auto& p) {
           return std::any_of(p.trials.begin(), p.trials.end(), draws);
         });
}

HoodScale::HoodScale(const HoodResults& results)
    : is_per_load(std::any_of(results.places.begin(), results.places.end(), [](const auto& place) {
        return std::any_of(place.trials.begin(), place.trials.end(),
                           [](const HoodTrial& trial) { return trial.load > 0.0; });
      })) {}

double HoodScale::factor(const HoodTrial& trial) const {
  constexpr double k_grams_per_tonne = 1e6;
  constexpr double k_grams_per_hour = 3.6e6;  // of 1 kg/s
  if (!is_per_load) return k_grams_per_hour;
  return trial.load > 0.0 ? k_grams_per_tonne / trial.load : 0.0;
}

Json hoods_json(const HoodResults& results) {
  const HoodScale scale(results);
  Json places = Json::array();
  for (const HoodPlace& place : results.places) {
    Json trials = Json::array();
    for (const HoodTrial& trial : place.trials) {
      trials.push_back(trial_json(trial, scale));
    }
    const auto needed = needed_flow(place, k_wanted);
    Json entry = {
        {"name", place.name}, {"trials", trials}, {"opening", nullptr}, {"needed", nullptr}};
    if (place.opening) entry["opening"] = {place.opening->x, place.opening->y, place.opening->z};
    if (needed) entry["needed"] = {{"flow_m3_per_s", needed->flow}, {"is_bound", needed->is_bound}};
    places.push_back(std::move(entry));
  }
  return {{"unit", scale.unit()},
          {"plain", results.plain ? trial_json(*results.plain, scale) : Json(nullptr)},
          {"has_others", results.has_others()},
          {"wanted", k_wanted},
          {"places", places}};
}

}  // namespace dust::study

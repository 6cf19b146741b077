// SPDX-License-Identifier: Apache-2.0
#include "study/calibration/calibration.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "study/calibration/cloud.hpp"
#include "study/calibration/landscape.hpp"
#include "study/noise.hpp"
#include "study/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace dust::study {
namespace {

/// The surrogates are precise enough where their error is below this share of the goal's.
constexpr double k_precise = 0.3;
/// How far from the best place it is still worth looking: the density is flattened by this.
constexpr double k_temperature = 4.0;
/// Two places nearer than this (of the cube's edge) are the same.
constexpr double k_same_place = 0.015;

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t d = 0; d < a.size(); ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return std::sqrt(sum);
}

RunErrors run_errors_of(const std::vector<Evaluation>& evaluations, std::size_t goal) {
  RunErrors sum;
  double squares = 0.0;
  for (const Evaluation& e : evaluations) {
    if (!e[goal].value) continue;
    ++sum.points;
    if (is_unsteady(e[goal])) {
      ++sum.unsteady;
    } else if (e[goal].error < 0.0) {
      ++sum.without;
    } else {
      squares += e[goal].error * e[goal].error;
    }
  }
  const std::size_t with = sum.points - sum.unsteady - sum.without;
  if (with > 0) sum.error = std::sqrt(squares / static_cast<double>(with));
  return sum;
}

class Calibrator {
 public:
  Calibrator(const CalibrationSettings& settings, Evaluator& evaluator,
             const std::function<void(const Calibration&)>& reported)
      : settings_(settings), evaluator_(evaluator), reported_(reported) {}

  Calibration run() {
    const std::size_t dimensions = settings_.parameters.size();
    const std::size_t fewest = make_surrogate(settings_.surrogate)->fewest(dimensions);
    std::size_t first = settings_.first_runs > 0 ? settings_.first_runs : 5 * dimensions;
    first = std::min(std::max(first, fewest + 1), settings_.runs);
    if (!evaluate(sobol(first, dimensions, settings_.seed))) return std::move(result_);
    conclude_now();
    // One run is kept for the best place.
    while (shares_.size() + 1 < settings_.runs && !is_precise()) {
      const std::size_t count = std::min(settings_.batch, settings_.runs - 1 - shares_.size());
      const Sample places = choose(count);
      if (places.empty()) break;
      if (!evaluate(places)) return std::move(result_);
      conclude_now();
    }
    if (shares_.size() < settings_.runs) {
      const std::vector<double> place = result_.landscape.best;
      if (!is_known(place, shares_) && evaluate({place})) conclude_now();
    }
    return std::move(result_);
  }

 private:
  bool evaluate(const Sample& shares) {
    std::vector<std::vector<double>> places;
    for (const auto& share : shares) {
      std::vector<double> place;
      for (std::size_t d = 0; d < share.size(); ++d) {
        const Freedom& p = settings_.parameters[d];
        // Five digits: a scenario that a person can read, and the same on every machine.
        const std::string text = base::digits_text(p.low + share[d] * (p.high - p.low), 5);
        place.push_back(std::strtod(text.c_str(), nullptr));
      }
      places.push_back(std::move(place));
    }
    const auto answers = evaluator_.evaluate(places);
    if (!answers) {
      result_.was_interrupted = true;
      return false;
    }
    for (std::size_t n = 0; n < places.size(); ++n) {
      shares_.push_back(shares[n]);
      result_.places.push_back(places[n]);
      result_.evaluations.push_back((*answers)[n]);
    }
    return true;
  }

  void conclude_now() {
    surrogates_ = learn(settings_, result_);
    result_.landscape = make_landscape(settings_, surrogates_);
    result_.scatter.clear();
    for (const auto& s : surrogates_) result_.scatter.push_back(s->scatter());
    result_.run_errors.clear();
    for (std::size_t g = 0; g < settings_.goals.size(); ++g) {
      result_.run_errors.push_back(run_errors_of(result_.evaluations, g));
    }
    result_.at_best = predictions_at(surrogates_, result_.landscape.best);
    conclude(settings_, result_);
    if (reported_) reported_(result_);
  }

  /// Largest ratio of the surrogate's error to the goal's within the region.
  [[nodiscard]] bool is_precise() const {
    const WeighedPlaces& l = result_.landscape.density();
    for (std::size_t n = 0; n < l.places.size(); ++n) {
      if (l.minus_log[n] > result_.landscape.region_level) continue;
      for (std::size_t g = 0; g < settings_.goals.size(); ++g) {
        const double limit = k_precise * settings_.goals[g].error;
        if (l.predictions[g][n].variance > limit * limit) return false;
      }
    }
    return true;
  }

  [[nodiscard]] static bool is_known(const std::vector<double>& place, const Sample& known) {
    return std::any_of(known.begin(), known.end(), [&](const std::vector<double>& other) {
      return distance(place, other) < k_same_place;
    });
  }

  /// What a run there would teach: unsure surrogates, plausible goals.
  [[nodiscard]] double gain_at(const WeighedPlaces& l, std::size_t n) const {
    double gain = 0.0;
    for (std::size_t g = 0; g < settings_.goals.size(); ++g) {
      const double error = settings_.goals[g].error;
      gain += std::log1p(l.predictions[g][n].variance / (error * error));
    }
    return gain * std::exp(-l.minus_log[n] / k_temperature);
  }

  /// Places where a run teaches most about the region.
  Sample choose(std::size_t count) {
    Sample chosen;
    Sample known = shares_;
    while (chosen.size() < count) {
      const Landscape landscape =
          chosen.empty() ? result_.landscape : make_landscape(settings_, surrogates_);
      double best = 0.0;
      const std::vector<double>* place = nullptr;
      for (const WeighedPlaces* l :
           {static_cast<const WeighedPlaces*>(&landscape), &landscape.cloud}) {
        for (std::size_t n = 0; n < l->places.size(); ++n) {
          const double gain = gain_at(*l, n);
          if (gain <= best || is_known(l->places[n], known)) continue;
          best = gain;
          place = &l->places[n];
        }
      }
      if (place == nullptr) break;
      chosen.push_back(*place);
      known.push_back(*place);
      for (const auto& s : surrogates_) s->add_virtual_run(*place);
    }
    return chosen;
  }

  const CalibrationSettings& settings_;
  Evaluator& evaluator_;
  const std::function<void(const Calibration&)>& reported_;
  Sample shares_;  ///< places in the cube
  std::vector<std::unique_ptr<Surrogate>> surrogates_;
  Calibration result_;
};

std::vector<double> share_of(const CalibrationSettings& settings,
                             const std::vector<double>& values) {
  std::vector<double> share;
  for (std::size_t d = 0; d < values.size(); ++d) {
    const Freedom& p = settings.parameters[d];
    share.push_back((values[d] - p.low) / (p.high - p.low));
  }
  return share;
}

}  // namespace

std::vector<std::unique_ptr<Surrogate>> learn(const CalibrationSettings& settings,
                                              const Calibration& calibration) {
  std::vector<std::unique_ptr<Surrogate>> all;
  for (std::size_t g = 0; g < settings.goals.size(); ++g) {
    std::vector<std::vector<double>> places;
    std::vector<double> values;
    std::vector<double> errors;
    for (std::size_t n = 0; n < calibration.places.size(); ++n) {
      const auto& [value, error, no_error] = calibration.evaluations[n][g];
      if (!value || !std::isfinite(*value)) continue;
      places.push_back(share_of(settings, calibration.places[n]));
      values.push_back(*value);
      errors.push_back(error);
    }
    all.push_back(make_surrogate(settings.surrogate));
    try {
      all.back()->fit(places, values, errors);
    } catch (const base::RunError& problem) {
      throw base::RunError(settings.goals[g].name + ": " + problem.what());
    }
  }
  return all;
}

double chi_of(const Goal& goal, const Prediction& prediction) {
  return (prediction.mean - goal.value) / std::sqrt(goal.error * goal.error + prediction.variance);
}

bool is_steady(const Calibration& calibration) {
  return std::all_of(calibration.run_errors.begin(), calibration.run_errors.end(),
                     [](const RunErrors& e) { return e.unsteady == 0; });
}

Calibration calibrate(const CalibrationSettings& settings, Evaluator& evaluator,
                      const std::function<void(const Calibration&)>& reported) {
  return Calibrator(settings, evaluator, reported).run();
}

bool is_in_region(const Calibration& calibration, const CalibrationSettings& settings,
                  const std::vector<double>& values) {
  const auto share = share_of(settings, values);
  const auto predictions = predictions_at(learn(settings, calibration), share);
  // The landscape counts from the density of its best place.
  const double least = fit_of(settings, calibration.at_best).minus_log;
  return fit_of(settings, predictions).minus_log - least <= calibration.landscape.region_level;
}

}  // namespace dust::study

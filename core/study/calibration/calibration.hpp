// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/calibration/surrogate.hpp"
#include "study/point_store.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dust::study {

/// What is to be met: a measured value with its standard error.
struct Goal {
  std::string name;
  std::string unit;
  double value = 0.0;
  double error = 0.0;
};

/// A parameter that is free within an interval.
struct Freedom {
  std::string name;
  std::string unit;
  double low = 0.0;
  double high = 0.0;
};

/// What came of one place: a value per goal with its standard error; no value where the run failed
/// or did not tell it.
using Evaluation = std::vector<OutputValue>;

/// What the points tell of their own errors in one goal.
struct RunErrors {
  double error = -1.0;       ///< root mean square of those told; negative: none is
  std::size_t points = 0;    ///< with a value
  std::size_t without = 0;   ///< that tell no error for another reason than the next
  std::size_t unsteady = 0;  ///< that have not settled
};

/// Answers for places, by running or by a formula.
class Evaluator {
 public:
  virtual ~Evaluator() = default;
  /// One evaluation per place, values of the parameters in their units. Nothing when it was
  /// interrupted.
  virtual std::optional<std::vector<Evaluation>> evaluate(
      const std::vector<std::vector<double>>& places) = 0;
};

struct CalibrationSettings {
  std::vector<Goal> goals;
  std::vector<Freedom> parameters;
  std::string surrogate = "gaussian_process";
  std::size_t runs = 30;       ///< at most
  std::size_t first_runs = 0;  ///< 0 = 5 per parameter
  std::size_t batch = 2;
  double confidence = 0.95;
  std::uint64_t seed = 1;  ///< of the first places
};

/// What the goals say of one parameter.
struct Estimate {
  double best = 0.0;  ///< at the likeliest place
  double mean = 0.0;
  double deviation = 0.0;
  double low = 0.0;  ///< ends of the confidence region along this parameter
  double high = 0.0;
  bool is_pinned = false;  ///< the region is narrower than half the interval and clear of its ends
};

/// Places in the unit cube, with what the surrogates say there and how plausible they are.
struct WeighedPlaces {
  std::vector<std::vector<double>> places;
  std::vector<std::vector<Prediction>> predictions;  ///< per goal, per place
  std::vector<double> minus_log;  ///< minus the logarithm of the density, from 0 at the best place
  std::vector<double> weight;     ///< of the density's volume that a place stands for
};

/// The plausibility of places on a regular grid over the cube (the first parameter runs fastest).
struct Landscape : WeighedPlaces {
  std::size_t per_direction = 0;
  double region_level = 0.0;  ///< the confidence region is where minus_log is at most this
  std::vector<double> best;   ///< the likeliest place, between those of the grid
  WeighedPlaces cloud;        ///< drawn from the density where the grid is too coarse; else empty

  /// The places that tell the density: those of the grid, or the cloud.
  [[nodiscard]] const WeighedPlaces& density() const {
    return cloud.places.empty() ? *this : cloud;
  }
};

/// The answer of a calibration.
struct Calibration {
  std::vector<std::vector<double>> places;  ///< that were run, in the units of the parameters
  std::vector<Evaluation> evaluations;
  std::vector<Estimate> estimates;
  std::vector<std::vector<double>> correlation;  ///< of the parameters, by the density
  std::vector<Prediction> at_best;               ///< per goal
  std::vector<double> scatter;                   ///< of single runs, per goal
  std::vector<RunErrors> run_errors;             ///< per goal
  double misfit = 0.0;  ///< sum over goals of (prediction - goal)^2 / (error^2 + variance), at best
  bool is_met = false;  ///< the misfit is one that errors explain
  bool is_pinned = false;  ///< all parameters are
  bool was_interrupted = false;
  std::vector<std::string> statements;  ///< the answer in sentences
  Landscape landscape;
};

/// Finds the parameters that meet the goals: Sobol places first, then places chosen where the
/// surrogates are unsure and the goals might be met, until the surrogates are precise within the
/// confidence region or the runs are used up; the best place is run last. The density is that of
/// independent normal errors of goals, surrogates and runs with a flat prior over the intervals;
/// the region is the smallest with the wanted probability. The places do not depend on how many are
/// run at a time by the evaluator. `told` hears of every batch.
Calibration calibrate(const CalibrationSettings& settings, Evaluator& evaluator,
                      const std::function<void(const Calibration&)>& reported = {});

/// Whether `values` lie in the confidence region.
bool is_in_region(const Calibration& calibration, const CalibrationSettings& settings,
                  const std::vector<double>& values);

/// How far a prediction lies from its goal, in standard errors: \f$ (p - v) / \sqrt{e^2 + s^2} \f$
/// with the goal's error e and that of the prediction s, which holds the errors of the runs.
double chi_of(const Goal& goal, const Prediction& prediction);

/// Whether no value rests on a run that has not settled.
bool is_steady(const Calibration& calibration);

/// Surrogates of all goals, learnt from what was run.
std::vector<std::unique_ptr<Surrogate>> learn(const CalibrationSettings& settings,
                                              const Calibration& calibration);

}  // namespace dust::study

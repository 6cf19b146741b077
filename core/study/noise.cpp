// SPDX-License-Identifier: Apache-2.0
#include "study/noise.hpp"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace dust::study {
namespace {

/// An effect below this many standard errors may be noise.
constexpr double k_clear = 2.0;
/// The 97.5 % quantile of Student's t.
double student(double freedom) {
  return boost::math::quantile(boost::math::students_t(freedom), 0.975);
}

}  // namespace

std::optional<Noise> noise_of(const Results& results, std::size_t output) {
  std::map<std::vector<std::size_t>, std::vector<double>> groups;
  double squares = 0.0;
  std::size_t reported = 0, unknown = 0;
  for (std::size_t n = 0; n < results.plan.points.size(); ++n) {
    const Outcome& outcome = results.outcomes[n];
    if (output >= outcome.outputs.size() || !outcome.outputs[output].value) continue;
    groups[results.plan.points[n].levels].push_back(*outcome.outputs[output].value);
    const double error = outcome.outputs[output].error;
    if (error < 0.0) {
      ++unknown;
      continue;
    }
    squares += error * error;
    ++reported;
  }
  double scatter = 0.0;
  std::size_t freedom = 0;
  for (const auto& [levels, values] : groups) {
    double mean = 0.0;
    for (const double v : values) mean += v / static_cast<double>(values.size());
    for (const double v : values) scatter += (v - mean) * (v - mean);
    freedom += values.size() - 1;
  }
  if (freedom > 0) {
    const auto count = static_cast<double>(freedom);
    return Noise{std::sqrt(scatter / count), count};
  }
  // The errors of some points say nothing of the others: where a run has not settled, least of all.
  if (reported > 0 && unknown == 0) {
    return Noise{std::sqrt(squares / static_cast<double>(reported)), k_free};
  }
  return std::nullopt;
}

double clear_limit(double freedom) {
  return std::isinf(freedom) ? k_clear : std::max(k_clear, student(freedom));
}

double error_of_mean(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double v : values) mean += v / n;
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / (n * (n - 1.0)));
}

bool is_unsteady(const OutputValue& output) {
  return output.value && output.error < 0.0 && output.no_error == k_not_steady;
}

}  // namespace dust::study

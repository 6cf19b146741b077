// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "study/calibration/conditional_process.hpp"
#include "study/calibration/surrogate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace dust::study {
namespace {

using Eigen::VectorXd;

/// Bounds of the scales.
constexpr double k_shortest = -2.3;     // 0.1
constexpr double k_longest = 2.3;       // 10
constexpr double k_min_scatter = -9.2;  // 1e-4
constexpr double k_max_scatter = 0.7;   // 2
/// Prior: lengths near 0.8 of the range within a factor of about 3. With ten runs the likelihood
/// alone often likes lengths of one spacing, which would tell nothing between the runs.
constexpr double k_likely_length = -0.2;
constexpr double k_length_spread = 1.1;

/// Steps of the chain, and how many of its places are kept: each costs a prediction as much again.
constexpr int k_steps = 600;
constexpr int k_kept = 12;
/// Half-widths of a step: ten runs hardly tell lengths and scatters apart that are nearer.
constexpr double k_length_step = 1.7;
constexpr double k_scatter_step = 3.5;

/// The mean over Gaussian processes of the scales that the runs leave possible.
class GaussianProcess final : public Surrogate {
 public:
  void fit(const std::vector<std::vector<double>>& places, const std::vector<double>& values,
           const std::vector<double>& errors) override {
    places_ = places;
    const std::size_t dimensions = places.empty() ? 0 : places.front().size();
    if (places.size() < fewest(dimensions)) {
      throw base::RunError("too few runs finished to learn from: " + std::to_string(places.size()));
    }
    values_ = Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    origin_ = values_.mean();
    unit_ = std::sqrt((values_.array() - origin_).square().mean());
    if (!(unit_ > 0.0)) unit_ = std::max(1e-12, std::abs(origin_) * 1e-9);
    values_ = (values_.array() - origin_) / unit_;
    walk(likeliest(dimensions));
    variances_of_runs_ = variances_above(errors, scatter());
    for (double& v : variances_of_runs_) v /= unit_ * unit_;
    if (!(mean_variance(variances_of_runs_) > 0.0)) variances_of_runs_.clear();
  }

  [[nodiscard]] Prediction at(const std::vector<double>& place) const override {
    double mean = 0.0, square = 0.0, variance = 0.0;
    for (const ConditionalProcess& process : processes_) {
      const Prediction p = process.at(place, variances_of_runs_);
      mean += p.mean;
      square += p.mean * p.mean;
      variance += p.variance;
    }
    const auto count = static_cast<double>(processes_.size());
    mean /= count;
    variance = variance / count + std::max(0.0, square / count - mean * mean);
    return {origin_ + unit_ * mean, unit_ * unit_ * variance};
  }

  void add_virtual_run(const std::vector<double>& place) override {
    for (ConditionalProcess& process : processes_) process.add_virtual_run(place);
    if (variances_of_runs_.empty()) return;
    variances_of_runs_.push_back(mean_variance(variances_of_runs_));
  }

  [[nodiscard]] double scatter() const override {
    double variance = 0.0;
    for (const ConditionalProcess& process : processes_) variance += process.scatter_variance();
    return unit_ * std::sqrt(variance / static_cast<double>(processes_.size()));
  }
  [[nodiscard]] std::size_t fewest(std::size_t dimensions) const override { return dimensions + 3; }

 private:
  /// Logarithm of the likelihood times the prior; minus infinity outside the bounds.
  [[nodiscard]] double score(const ProcessScales& scales) const {
    double sum = 0.0;
    for (const double length : scales.lengths) {
      if (length < k_shortest || length > k_longest) return -infinity();
      const double z = (length - k_likely_length) / k_length_spread;
      sum -= 0.5 * z * z;
    }
    if (scales.scatter < k_min_scatter || scales.scatter > k_max_scatter) return -infinity();
    sum += ConditionalProcess(places_, values_, scales).likelihood();
    return std::isfinite(sum) ? sum : -infinity();
  }

  static double infinity() { return std::numeric_limits<double>::infinity(); }

  /// The best of a few scales: where the chain begins.
  [[nodiscard]] ProcessScales likeliest(std::size_t dimensions) const {
    ProcessScales best;
    double best_score = -infinity();
    for (const double length : {-1.0, 0.0, 1.0}) {
      for (const double scatter : {-6.0, -3.0, -1.0}) {
        const ProcessScales scales{std::vector<double>(dimensions, length), scatter};
        const double there = score(scales);
        if (there <= best_score && !best.lengths.empty()) continue;
        best = scales;
        best_score = there;
      }
    }
    return best;
  }

  /// A chain of Metropolis, the same every time.
  void walk(ProcessScales here) {
    std::mt19937_64 random(1);
    const auto draw = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
    const std::size_t dimensions = here.lengths.size();
    double score_here = score(here);
    processes_.clear();
    for (int step = 0; step < k_steps; ++step) {
      ProcessScales there = here;
      const std::size_t d = random() % (dimensions + 1);
      const bool is_length = d < dimensions;
      (is_length ? there.lengths[d] : there.scatter) +=
          (is_length ? k_length_step : k_scatter_step) * (2.0 * draw() - 1.0);
      const double score_there = score(there);
      if (std::log(draw() + 1e-300) < score_there - score_here) {
        here = there;
        score_here = score_there;
      }
      if ((step + 1) % (k_steps / k_kept) == 0) processes_.emplace_back(places_, values_, here);
    }
  }

  std::vector<std::vector<double>> places_;
  VectorXd values_;  ///< in units of their own scatter
  double origin_ = 0.0;
  double unit_ = 1.0;
  std::vector<ConditionalProcess> processes_;
  std::vector<double> variances_of_runs_;  ///< beyond the scatter, in units of values_ squared
};

}  // namespace

std::vector<double> variances_above(const std::vector<double>& errors, double scatter) {
  std::vector<double> variances;
  for (const double e : errors) {
    variances.push_back(e > scatter ? e * e - scatter * scatter : 0.0);
  }
  return variances;
}

double mean_variance(const std::vector<double>& variances) {
  double sum = 0.0;
  for (const double v : variances) sum += v;
  return variances.empty() ? 0.0 : sum / static_cast<double>(variances.size());
}

std::unique_ptr<Surrogate> make_gaussian_process() { return std::make_unique<GaussianProcess>(); }

std::unique_ptr<Surrogate> make_surrogate(const std::string& name) {
  return name == "quadratic" ? make_quadratic() : make_gaussian_process();
}

}  // namespace dust::study

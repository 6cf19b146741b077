// SPDX-License-Identifier: Apache-2.0
#include "study/calibration/surrogate.hpp"

#include "base/error.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::study {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Bounds of the hyperparameters, as logarithms: lengths in units of the range, and the scatter of
/// a run over the process's own standard deviation.
constexpr double k_shortest = -2.3;     // 0.1
constexpr double k_longest = 2.3;       // 10
constexpr double k_min_scatter = -9.2;  // 1e-4
constexpr double k_max_scatter = 0.7;   // 2
/// Prior: lengths near 0.8 of the range within a factor of about 3. With ten runs the likelihood
/// alone often likes lengths of one spacing, which would tell nothing between the runs.
constexpr double k_likely_length = -0.2;
constexpr double k_length_spread = 1.1;

double matern(double r) {
  const double q = std::sqrt(5.0) * r;
  return (1.0 + q + q * q / 3.0) * std::exp(-q);
}

class GaussianProcess final : public Surrogate {
 public:
  void fit(const std::vector<std::vector<double>>& places, const std::vector<double>& values,
           const std::vector<double>& errors) override {
    places_ = places;
    const std::size_t dimensions = places.empty() ? 0 : places.front().size();
    if (places.size() < fewest(dimensions)) {
      throw base::RunError("too few runs finished to learn from: " + std::to_string(places.size()));
    }
    y_ = Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    const double mean = y_.mean();
    unit_ = std::sqrt((y_.array() - mean).square().mean());
    if (!(unit_ > 0.0)) unit_ = std::max(1e-12, std::abs(mean) * 1e-9);
    origin_ = mean;
    y_ = (y_.array() - mean) / unit_;
    search(dimensions);
    factorise();
    unheld_ = variances_above(errors, scatter());
  }

  [[nodiscard]] Prediction at(const std::vector<double>& place) const override {
    const VectorXd r = correlations(place);
    const VectorXd h = trend(place);
    const VectorXd solved = factor_.solve(r);
    const double mean = h.dot(beta_) + r.dot(weights_);
    const VectorXd u = h - basis_.transpose() * solved;
    const VectorXd of_trend = trend_factor_.solve(u);
    const double variance = 1.0 - r.dot(solved) + u.dot(of_trend);
    const VectorXd w = solved + solved_basis_ * of_trend;  // mean = w . y
    double of_runs = 0.0;
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      of_runs += w[i] * w[i] * unheld_[static_cast<std::size_t>(i)];
    }
    return {origin_ + unit_ * mean, unit_ * unit_ * sigma2_ * std::max(0.0, variance) + of_runs};
  }

  void add_virtual_run(const std::vector<double>& place) override {
    const double expected = (at(place).mean - origin_) / unit_;
    const double sigma2 = sigma2_;
    places_.push_back(place);
    y_.conservativeResize(y_.size() + 1);
    y_[y_.size() - 1] = expected;
    unheld_.push_back(mean_variance(unheld_));
    factorise();
    sigma2_ = sigma2;  // what is expected teaches nothing about the scale
  }

  [[nodiscard]] double scatter() const override {
    return unit_ * std::sqrt(sigma2_) * std::exp(parameters_.back());
  }
  [[nodiscard]] std::size_t fewest(std::size_t dimensions) const override { return dimensions + 3; }

 private:
  [[nodiscard]] static VectorXd trend(const std::vector<double>& x) {
    VectorXd h(static_cast<Eigen::Index>(x.size() + 1));
    h[0] = 1.0;
    for (std::size_t d = 0; d < x.size(); ++d) h[static_cast<Eigen::Index>(d + 1)] = x[d];
    return h;
  }
  [[nodiscard]] double correlation(const std::vector<double>& a,
                                   const std::vector<double>& b) const {
    double k = 1.0;
    for (std::size_t d = 0; d < a.size(); ++d) {
      k *= matern(std::abs(a[d] - b[d]) * std::exp(-parameters_[d]));
    }
    return k;
  }
  [[nodiscard]] VectorXd correlations(const std::vector<double>& x) const {
    VectorXd r(static_cast<Eigen::Index>(places_.size()));
    for (std::size_t n = 0; n < places_.size(); ++n) {
      r[static_cast<Eigen::Index>(n)] = correlation(x, places_[n]);
    }
    return r;
  }

  /// Everything that follows from places, values and hyperparameters; returns the logarithm of the
  /// restricted likelihood (up to a constant).
  double factorise() {
    const auto n = static_cast<Eigen::Index>(places_.size());
    MatrixXd k(n, n);
    basis_.resize(n, static_cast<Eigen::Index>(places_.front().size() + 1));
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& a = places_[static_cast<std::size_t>(i)];
      basis_.row(i) = trend(a);
      for (Eigen::Index j = 0; j <= i; ++j) {
        k(i, j) = correlation(a, places_[static_cast<std::size_t>(j)]);
        k(j, i) = k(i, j);
      }
    }
    const double g = std::exp(parameters_.back());
    k.diagonal().array() += g * g;
    factor_.compute(k);
    solved_basis_ = factor_.solve(basis_);
    const MatrixXd normal = basis_.transpose() * solved_basis_;
    trend_factor_.compute(normal);
    beta_ = trend_factor_.solve(solved_basis_.transpose() * y_);
    const VectorXd rest = y_ - basis_ * beta_;
    weights_ = factor_.solve(rest);
    const auto freedom = static_cast<double>(n - basis_.cols());
    sigma2_ = std::max(1e-12, rest.dot(weights_) / freedom);
    if (factor_.info() != Eigen::Success || trend_factor_.info() != Eigen::Success) {
      return -std::numeric_limits<double>::infinity();
    }
    const MatrixXd lower = factor_.matrixL();
    const MatrixXd trend_lower = trend_factor_.matrixL();
    return -0.5 * freedom * std::log(sigma2_) - lower.diagonal().array().log().sum() -
           trend_lower.diagonal().array().log().sum();
  }

  double score(const std::vector<double>& parameters) {
    parameters_ = parameters;
    double sum = factorise();
    for (std::size_t d = 0; d + 1 < parameters.size(); ++d) {
      const double z = (parameters[d] - k_likely_length) / k_length_spread;
      sum -= 0.5 * z * z;
    }
    return std::isfinite(sum) ? sum : -std::numeric_limits<double>::infinity();
  }

  /// The likeliest hyperparameters: compass search from several starts, the same every time.
  void search(std::size_t dimensions) {
    std::vector<double> best;
    double best_score = -std::numeric_limits<double>::infinity();
    for (const double length : {-1.0, 0.0, 1.0}) {
      for (const double scatter : {-6.0, -3.0, -1.0}) {
        std::vector<double> at(dimensions + 1, length);
        at.back() = scatter;
        double here = score(at);
        for (double step = 1.0; step > 0.05;) {
          bool is_better = false;
          for (std::size_t d = 0; d <= dimensions; ++d) {
            const bool is_length = d < dimensions;
            for (const double sign : {1.0, -1.0}) {
              std::vector<double> next = at;
              next[d] = std::clamp(next[d] + sign * step, is_length ? k_shortest : k_min_scatter,
                                   is_length ? k_longest : k_max_scatter);
              const double there = score(next);
              if (there <= here + 1e-9) continue;
              at = next;
              here = there;
              is_better = true;
            }
          }
          if (!is_better) step *= 0.5;
        }
        if (here > best_score) {
          best_score = here;
          best = at;
        }
      }
    }
    parameters_ = best.empty() ? std::vector<double>(dimensions + 1, 0.0) : best;
  }

  std::vector<std::vector<double>> places_;
  VectorXd y_;  ///< in units of its own scatter
  double origin_ = 0.0;
  double unit_ = 1.0;
  std::vector<double> parameters_;  ///< logarithms of the lengths and of the scatter
  MatrixXd basis_;
  MatrixXd solved_basis_;
  std::vector<double>
      unheld_;  ///< variances of runs beyond the scatter, in the values' unit squared
  Eigen::LLT<MatrixXd> factor_;
  Eigen::LLT<MatrixXd> trend_factor_;
  VectorXd beta_;
  VectorXd weights_;
  double sigma2_ = 1.0;
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

// SPDX-License-Identifier: Apache-2.0
#include "study/calibration/conditional_process.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dust::study {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd trend(const std::vector<double>& x) {
  VectorXd h(static_cast<Eigen::Index>(x.size() + 1));
  h[0] = 1.0;
  for (std::size_t d = 0; d < x.size(); ++d) h[static_cast<Eigen::Index>(d + 1)] = x[d];
  return h;
}

/// Mean of 1/chi^2 of `freedom` runs beyond the trend, times `freedom`: a variance learnt from few
/// runs is as often too small as too large, and what is too small misleads more. Below three the
/// mean does not exist.
double inflation(double freedom) { return freedom / std::max(freedom - 2.0, 0.5); }

}  // namespace

ConditionalProcess::ConditionalProcess(std::vector<std::vector<double>> places, VectorXd values,
                                       const ProcessScales& scales)
    : places_(std::move(places)),
      values_(std::move(values)),
      share_of_scatter_(std::exp(2.0 * scales.scatter)) {
  for (const double length : scales.lengths) {
    inverse_lengths_.push_back(std::sqrt(5.0) * std::exp(-length));
  }
  factorise();
  const VectorXd rest = values_ - basis_ * beta_;
  const auto freedom = static_cast<double>(basis_.rows() - basis_.cols());
  const double variance = std::max(1e-12, rest.dot(weights_) / freedom);
  variance_ = inflation(freedom) * variance;
  if (factor_.info() != Eigen::Success || trend_factor_.info() != Eigen::Success) {
    likelihood_ = -std::numeric_limits<double>::infinity();
    return;
  }
  const MatrixXd lower = factor_.matrixL();
  const MatrixXd trend_lower = trend_factor_.matrixL();
  likelihood_ = -0.5 * freedom * std::log(variance) - lower.diagonal().array().log().sum() -
                trend_lower.diagonal().array().log().sum();
}

/// Product of Matern functions (1 + q + q^2/3) exp(-q), q = sqrt(5) |x - x'|/l.
double ConditionalProcess::correlation(const std::vector<double>& a,
                                       const std::vector<double>& b) const {
  double k = 1.0;
  double sum = 0.0;
  for (std::size_t d = 0; d < a.size(); ++d) {
    const double q = std::abs(a[d] - b[d]) * inverse_lengths_[d];
    k *= 1.0 + q * (1.0 + q / 3.0);
    sum += q;
  }
  return k * std::exp(-sum);
}

void ConditionalProcess::factorise() {
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
  k.diagonal().array() += share_of_scatter_;
  factor_.compute(k);
  solved_basis_ = factor_.solve(basis_);
  trend_factor_.compute(basis_.transpose() * solved_basis_);
  beta_ = trend_factor_.solve(solved_basis_.transpose() * values_);
  weights_ = factor_.solve(values_ - basis_ * beta_);
}

double ConditionalProcess::scatter_variance() const { return variance_ * share_of_scatter_; }

Prediction ConditionalProcess::at(const std::vector<double>& place,
                                  const std::vector<double>& variances_of_runs) const {
  VectorXd r(static_cast<Eigen::Index>(places_.size()));
  for (std::size_t n = 0; n < places_.size(); ++n) {
    r[static_cast<Eigen::Index>(n)] = correlation(place, places_[n]);
  }
  const VectorXd h = trend(place);
  const double mean = h.dot(beta_) + r.dot(weights_);
  const VectorXd u = h - solved_basis_.transpose() * r;
  const VectorXd of_trend = trend_factor_.solve(u);
  const double of_trend_variance = u.dot(of_trend);
  double of_runs = 0.0;
  if (!variances_of_runs.empty()) {
    const VectorXd w = factor_.solve(r) + solved_basis_ * of_trend;  // mean = w . values
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      of_runs += w[i] * w[i] * variances_of_runs[static_cast<std::size_t>(i)];
    }
  }
  factor_.matrixL().solveInPlace(r);
  const double variance = 1.0 - r.squaredNorm() + of_trend_variance;
  return {mean, variance_ * std::max(0.0, variance) + of_runs};
}

void ConditionalProcess::add_virtual_run(const std::vector<double>& place) {
  const double expected = at(place, {}).mean;
  places_.push_back(place);
  values_.conservativeResize(values_.size() + 1);
  values_[values_.size() - 1] = expected;
  factorise();  // what is expected teaches nothing about the variance
}

}  // namespace dust::study

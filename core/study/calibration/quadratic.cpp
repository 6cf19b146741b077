// SPDX-License-Identifier: Apache-2.0
#include "study/calibration/surrogate.hpp"

#include "base/error.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace dust::study {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Quadratic final : public Surrogate {
 public:
  void fit(const std::vector<std::vector<double>>& places, const std::vector<double>& values,
           const std::vector<double>& errors) override {
    const std::size_t dimensions = places.empty() ? 0 : places.front().size();
    if (places.size() < fewest(dimensions)) {
      throw base::RunError("too few runs finished to learn from: " + std::to_string(places.size()));
    }
    const auto n = static_cast<Eigen::Index>(places.size());
    basis_.resize(n, terms(places.front()).size());
    for (Eigen::Index i = 0; i < n; ++i) {
      basis_.row(i) = terms(places[static_cast<std::size_t>(i)]);
    }
    const VectorXd y = Eigen::Map<const VectorXd>(values.data(), n);
    normal_ = basis_.transpose() * basis_;
    factor_.compute(normal_);
    beta_ = factor_.solve(basis_.transpose() * y);
    const double rest = (y - basis_ * beta_).squaredNorm();
    variance_ = rest / static_cast<double>(n - basis_.cols());
    unheld_ = variances_above(errors, scatter());
  }

  [[nodiscard]] Prediction at(const std::vector<double>& place) const override {
    const VectorXd h = terms(place);
    const VectorXd solved = factor_.solve(h);
    const VectorXd w = basis_ * solved;  // mean = w . y
    double of_runs = 0.0;
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      of_runs += w[i] * w[i] * unheld_[static_cast<std::size_t>(i)];
    }
    return {h.dot(beta_), variance_ * std::max(0.0, h.dot(solved)) + of_runs};
  }

  void add_virtual_run(const std::vector<double>& place) override {
    const VectorXd h = terms(place);
    normal_ += h * h.transpose();
    basis_.conservativeResize(basis_.rows() + 1, Eigen::NoChange);
    basis_.row(basis_.rows() - 1) = h;
    unheld_.push_back(mean_variance(unheld_));
    factor_.compute(normal_);
  }

  [[nodiscard]] double scatter() const override { return std::sqrt(variance_); }
  /// Two more than coefficients, so that there is a misfit to speak of.
  [[nodiscard]] std::size_t fewest(std::size_t dimensions) const override {
    return (dimensions + 1) * (dimensions + 2) / 2 + 2;
  }

 private:
  /// 1, x_i - 1/2 and their products.
  [[nodiscard]] static VectorXd terms(const std::vector<double>& place) {
    std::vector<double> all = {1.0};
    for (std::size_t i = 0; i < place.size(); ++i) {
      all.push_back(place[i] - 0.5);
      for (std::size_t j = 0; j <= i; ++j) all.push_back((place[i] - 0.5) * (place[j] - 0.5));
    }
    return Eigen::Map<const VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }

  MatrixXd basis_;
  MatrixXd normal_;
  std::vector<double> unheld_;  ///< variances of runs beyond the scatter
  Eigen::LDLT<MatrixXd> factor_;
  VectorXd beta_;
  double variance_ = 0.0;
};

}  // namespace

std::unique_ptr<Surrogate> make_quadratic() { return std::make_unique<Quadratic>(); }

}  // namespace dust::study

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
  void fit(const std::vector<std::vector<double>>& places,
           const std::vector<double>& values) override {
    const std::size_t dimensions = places.empty() ? 0 : places.front().size();
    if (places.size() < fewest(dimensions)) {
      throw base::RunError("too few runs finished to learn from: " + std::to_string(places.size()));
    }
    const auto n = static_cast<Eigen::Index>(places.size());
    MatrixXd basis(n, terms(places.front()).size());
    for (Eigen::Index i = 0; i < n; ++i) {
      basis.row(i) = terms(places[static_cast<std::size_t>(i)]);
    }
    const VectorXd y = Eigen::Map<const VectorXd>(values.data(), n);
    normal_ = basis.transpose() * basis;
    factor_.compute(normal_);
    beta_ = factor_.solve(basis.transpose() * y);
    const double rest = (y - basis * beta_).squaredNorm();
    variance_ = rest / static_cast<double>(n - basis.cols());
  }

  [[nodiscard]] Prediction at(const std::vector<double>& place) const override {
    const VectorXd h = terms(place);
    return {h.dot(beta_), variance_ * std::max(0.0, h.dot(factor_.solve(h)))};
  }

  void add_virtual_run(const std::vector<double>& place) override {
    const VectorXd h = terms(place);
    normal_ += h * h.transpose();
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

  MatrixXd normal_;
  Eigen::LDLT<MatrixXd> factor_;
  VectorXd beta_;
  double variance_ = 0.0;
};

}  // namespace

std::unique_ptr<Surrogate> make_quadratic() { return std::make_unique<Quadratic>(); }

}  // namespace dust::study

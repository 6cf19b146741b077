// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/calibration/surrogate.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include <vector>

namespace dust::study {

/// What a Gaussian process is made of, as logarithms.
struct ProcessScales {
  std::vector<double> lengths;  ///< by direction, in units of the range
  double scatter = 0.0;         ///< of a run over the process's own standard deviation
};

/// A Gaussian process on a linear trend whose lengths and scatter are given: see
/// make_gaussian_process for what it assumes. Values are of the order of one.
class ConditionalProcess {
 public:
  ConditionalProcess(std::vector<std::vector<double>> places, Eigen::VectorXd values,
                     const ProcessScales& scales);

  /// Logarithm of the restricted likelihood, up to a constant; minus infinity where nothing can be
  /// computed.
  [[nodiscard]] double likelihood() const { return likelihood_; }
  /// Variance of a run about the mean.
  [[nodiscard]] double scatter_variance() const;
  /// `variances_of_runs`: what their own errors add, see Surrogate::fit; empty:
  /// nothing.
  [[nodiscard]] Prediction at(const std::vector<double>& place,
                              const std::vector<double>& variances_of_runs) const;
  /// See Surrogate::add_virtual_run.
  void add_virtual_run(const std::vector<double>& place);

 private:
  [[nodiscard]] double correlation(const std::vector<double>& a,
                                   const std::vector<double>& b) const;
  void factorise();

  std::vector<std::vector<double>> places_;
  Eigen::VectorXd values_;
  std::vector<double> inverse_lengths_;  ///< times the root of 5
  double share_of_scatter_;              ///< of the process's variance
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd solved_basis_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::LLT<Eigen::MatrixXd> trend_factor_;
  Eigen::VectorXd beta_;
  Eigen::VectorXd weights_;
  double variance_ = 1.0;  ///< of the process, known from few runs
  double likelihood_ = 0.0;
};

}  // namespace dust::study

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace dust::study {

/// What a surrogate says of a place: its mean and the variance of that mean (without the scatter of
/// single runs).
struct Prediction {
  double mean = 0.0;
  double variance = 0.0;
};

/// Stands in for runs between those that were made. Places are in the unit cube.
class Surrogate {
 public:
  virtual ~Surrogate() = default;
  /// Learns from `values` at `places`; throws base::RunError with too few of them. `errors`:
  /// standard errors of the values, negative where they tell none. Where they are larger than the
  /// scatter learnt, predictions carry the rest: \f$ \sum_i w_i^2 \max(0, e_i^2 - s^2) \f$ for a
  /// mean \f$ \sum_i w_i y_i \f$ (own derivation: errors of runs are independent).
  virtual void fit(const std::vector<std::vector<double>>& places,
                   const std::vector<double>& values, const std::vector<double>& errors) = 0;
  /// Of values that tell no errors.
  void fit(const std::vector<std::vector<double>>& places, const std::vector<double>& values) {
    fit(places, values, std::vector<double>(values.size(), -1.0));
  }
  [[nodiscard]] virtual Prediction at(const std::vector<double>& place) const = 0;
  /// Takes a run at `place` for granted that gives what is expected there: only variances change.
  /// So that several places are chosen at a time.
  virtual void add_virtual_run(const std::vector<double>& place) = 0;
  /// Standard deviation of a single run about the mean, as learnt.
  [[nodiscard]] virtual double scatter() const = 0;
  /// Fewest runs it can learn from.
  [[nodiscard]] virtual std::size_t fewest(std::size_t dimensions) const = 0;
};

/// The part of the variances of `errors` that `scatter` does not hold.
std::vector<double> variances_above(const std::vector<double>& errors, double scatter);
/// Their mean, for a run that is taken for granted.
double mean_variance(const std::vector<double>& variances);

/// Gaussian process on a linear trend,
/// \f$ y = h(x)^T b + z(x) + e \f$, \f$ \mathrm{cov}(z) = s^2 \prod_d k(|x_d - x'_d| / l_d) \f$
/// with the Matern function of order 5/2; b and s^2 by generalised least squares (Rasmussen and
/// Williams 2006, chapters 2.7 and 4.2). Few runs hardly tell shape from scatter, so that nothing
/// rests on one pair of lengths and scatter: predictions are means over a chain of them, drawn by
/// their restricted likelihood with a weak prior on the lengths (chapter 5.2), and s^2 allows for
/// the number of runs that it is known from.
std::unique_ptr<Surrogate> make_gaussian_process();

/// Full quadratic polynomial by least squares (a response surface, Box and Wilson 1951); its
/// variance takes the misfit for scatter.
std::unique_ptr<Surrogate> make_quadratic();

/// By the name of the scenario key: gaussian_process, quadratic.
std::unique_ptr<Surrogate> make_surrogate(const std::string& name);

}  // namespace dust::study

// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::run {

/// The time from which on a stream counts as steady, and its means are taken.
class SteadyWindow {
 public:
  /// Of a step: times are sums of steps.
  static constexpr double k_rounding = 0.01;

  explicit SteadyWindow(double begin) : begin_(begin) {}
  [[nodiscard]] double begin() const { return begin_; }  ///< [s]
  /// Whether `time` [s] is in it, where steps of `step` [s] are made.
  [[nodiscard]] bool holds(double time, double step) const {
    return time >= begin_ - k_rounding * step;
  }

 private:
  double begin_;
};

}  // namespace dust::run

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace dust::fluid {

/// Interval of time [s].
struct Interval {
  double begin = 0.0;
  double end = 0.0;

  [[nodiscard]] double length() const { return end - begin; }
};

/// Numbers that vary in time, always as many.
using TimeFunction = std::function<std::vector<double>(double time)>;

/// Mean of the numbers over an interval, by Simpson's rule on parts that are halved until it is
/// exact: also across jumps and kinks. Nothing where no sample differs from another. What lasts
/// shorter than 1/16 of the interval may fall between two samples, and numbers that jump
/// everywhere, like noise, have a mean of some thousand samples.
[[nodiscard]] std::optional<std::vector<double>> time_mean(Interval over, const TimeFunction& f);

}  // namespace dust::fluid

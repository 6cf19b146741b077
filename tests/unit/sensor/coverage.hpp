// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/sensor_bench.hpp"

#include <cmath>
#include <numbers>

namespace dust::test {

/// Counts how often an estimate lies within one and two of its standard errors of the truth.
struct Coverage {
  int runs = 0;
  int within_one = 0;
  int within_two = 0;
  int without_error = 0;

  void add(const Figure& figure, double truth) {
    ++runs;
    if (figure.uncertainty < 0.0) {
      ++without_error;
      return;
    }
    const double off = std::abs(figure.value - truth);
    within_one += off <= figure.uncertainty;
    within_two += off <= 2.0 * figure.uncertainty;
  }
  [[nodiscard]] double one() const { return static_cast<double>(within_one) / runs; }
  [[nodiscard]] double two() const { return static_cast<double>(within_two) / runs; }
};

// A normal error is within one standard error in 68 % and within two in 95 % of the runs. With 16
// to 31 batches (Student's t) it is 67 and 93 to 94 %; 300 runs scatter by 2.7 and 1.4 %. The
// bounds are three of these away.
inline constexpr int k_runs = 300;
inline constexpr double k_one_low = 0.59;
inline constexpr double k_one_high = 0.77;
inline constexpr double k_two_low = 0.89;

/// Random numbers of one synthetic run.
class Dice {
 public:
  explicit Dice(int run) : random_(static_cast<std::uint64_t>(run) + 1, sdk::stream_of("test")) {}
  double uniform() { return random_.uniform(next_++, 0); }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  int poisson(double mean) {
    const double limit = std::exp(-mean);
    int n = -1;
    for (double product = 1.0; product > limit; ++n) product *= uniform();
    return n;
  }

 private:
  sdk::Random random_;
  std::uint64_t next_ = 0;
};

}  // namespace dust::test

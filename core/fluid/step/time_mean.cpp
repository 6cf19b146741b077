// SPDX-License-Identifier: Apache-2.0
#include "fluid/step/time_mean.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dust::fluid {
namespace {

constexpr int k_parts = 8;
/// Of the largest number: what halving a part once more may change its contribution by.
constexpr double k_exact = 1e-11;
constexpr int k_max_halvings = 48;
/// Enough for a dozen jumps in the interval; what varies like noise is not followed further.
constexpr int k_max_samples = 2000;

using Numbers = std::vector<double>;

/// A part of the interval with the numbers at its ends and in its middle.
struct Part {
  double begin;
  double length;
  Numbers first;
  Numbers middle;
  Numbers last;

  [[nodiscard]] double simpson(std::size_t n) const {
    return length / 6.0 * (first[n] + 4.0 * middle[n] + last[n]);
  }
};

/// Sums the integrals of parts.
class PartSum {
 public:
  PartSum(const TimeFunction& f, double tolerance, std::size_t count)
      : f_(f), tolerance_(tolerance), sum_(count, 0.0) {}

  void add(const Part& whole, int halvings) {
    const double half = 0.5 * whole.length;
    samples_ += 2;
    Part low{whole.begin, half, whole.first, f_(whole.begin + 0.5 * half), whole.middle};
    Part high{whole.begin + half, half, whole.middle, f_(whole.begin + 1.5 * half), whole.last};
    double change = 0.0;
    for (std::size_t n = 0; n < sum_.size(); ++n) {
      change = std::max(change, std::abs(low.simpson(n) + high.simpson(n) - whole.simpson(n)));
    }
    if (change <= tolerance_ || halvings == k_max_halvings || samples_ > k_max_samples) {
      for (std::size_t n = 0; n < sum_.size(); ++n) sum_[n] += low.simpson(n) + high.simpson(n);
      return;
    }
    add(low, halvings + 1);
    add(high, halvings + 1);
  }
  [[nodiscard]] const Numbers& sum() const { return sum_; }

 private:
  const TimeFunction& f_;
  double tolerance_;
  Numbers sum_;
  int samples_ = 0;
};

}  // namespace

std::optional<Numbers> time_mean(Interval over, const TimeFunction& f) {
  std::vector<Numbers> samples;
  for (int n = 0; n <= 2 * k_parts; ++n) {
    samples.push_back(f(over.begin + over.length() * n / (2 * k_parts)));
  }
  if (std::all_of(samples.begin(), samples.end(),
                  [&](const Numbers& s) { return s == samples.front(); })) {
    return std::nullopt;
  }
  double scale = 0.0;
  for (const Numbers& sample : samples) {
    for (const double v : sample) scale = std::max(scale, std::abs(v));
  }
  PartSum integral(f, k_exact * scale * over.length(), samples.front().size());
  const double length = over.length() / k_parts;
  for (int p = 0; p < k_parts; ++p) {
    const auto at = static_cast<std::size_t>(2 * p);
    integral.add({over.begin + p * length, length, samples[at], samples[at + 1], samples[at + 2]},
                 0);
  }
  Numbers mean = integral.sum();
  for (double& v : mean) v /= over.length();
  return mean;
}

}  // namespace dust::fluid

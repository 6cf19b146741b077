// SPDX-License-Identifier: Apache-2.0
// The memory of the viscous layer, against integrals known in closed form.
#include "fluid_force/basset/basset.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace {

using dust::test::approx;
using namespace dust::model;
using dust::sdk::Vec3;

constexpr double k_forever = 1e9;

struct Grain {
  std::vector<double> row = std::vector<double>(basset::History::k_numbers, 0.0);
  [[nodiscard]] basset::History history() { return basset::History(row.data()); }
};

TEST_CASE("after a sudden start the integral shall fall like one over the root of time") {
  // w jumps to 3 and stays: the integral is 3 / sqrt(t), its mean over (t, t + dt)
  // 6 (sqrt(t + dt) - sqrt(t)) / dt.
  constexpr double k_step = 1e-3;
  Grain grain;
  for (int n = 0; n < 12000; ++n) {
    auto h = grain.history();
    h.note({3.0, 0, 0}, true);
    const double got = h.past(k_step, k_forever).x;
    const double t = n * k_step;
    if (n != 0 && n != 1 && n != 10 && n != 100 && n != 1000 && n != 11999) continue;
    CAPTURE(n);
    // Until it is joined with younger pieces the jump is exact; then a piece spans a quarter of its
    // age at most, which costs up to 2.7 %.
    const double expected = 6.0 * (std::sqrt(t + k_step) - std::sqrt(t)) / k_step;
    CHECK(got == approx(expected).epsilon(n < 5 ? 1e-9 : 0.03));
  }
}

TEST_CASE("a slip that was there for long shall leave no memory") {
  Grain grain;
  for (int n = 0; n < 50; ++n) {
    auto h = grain.history();
    h.note({3.0, -1.0, 0}, false);
    CHECK(norm(h.past(1e-3, k_forever)) == 0.0);
  }
}

TEST_CASE("under constant acceleration the integral shall grow like the root of time") {
  // w = 5 t: the integral of the past alone, seen at t + s, is 10 (sqrt(t + s) - sqrt(s)).
  constexpr double k_step = 2e-4;
  Grain grain;
  for (int n = 0; n <= 12000; ++n) {
    auto h = grain.history();
    const double t = n * k_step;
    h.note({0, 0, 5.0 * t}, true);
    const double got = h.past(k_step, k_forever).z;
    if (n != 1 && n != 7 && n != 300 && n != 12000) continue;
    CAPTURE(n);
    const auto power = [](double x) { return x * std::sqrt(x); };
    const double expected = 20.0 / (3.0 * k_step) * (power(t + k_step) - power(t) - power(k_step));
    // The rate is constant: joined pieces are exact, too. Differences of powers lose 7 digits.
    CHECK(got == approx(expected).epsilon(1e-6));
  }
}

TEST_CASE("the window shall forget what is older") {
  constexpr double k_step = 1e-3;
  Grain grain;
  double inside = 0.0;
  double outside = 0.0;
  for (int n = 0; n < 200; ++n) {
    auto h = grain.history();
    h.note({1.0, 0, 0}, true);
    inside = h.past(k_step, k_forever).x;
    outside = h.past(k_step, 0.05).x;
  }
  CHECK(inside == approx(1.0 / std::sqrt(0.2)).epsilon(0.03));
  CHECK(outside == 0.0);
}

TEST_CASE("steps of different length shall give the same history") {
  // w = 5 t again, in steps that change by a factor of 4.
  Grain grain;
  double t = 0.0;
  for (int n = 0; n < 400; ++n) {
    const double step = n % 3 == 0 ? 4e-4 : 1e-4;
    auto h = grain.history();
    h.note({5.0 * t, 0, 0}, true);
    const double got = h.past(step, k_forever).x;
    const auto power = [](double x) { return x * std::sqrt(x); };
    const double expected = 20.0 / (3.0 * step) * (power(t + step) - power(t) - power(step));
    if (n > 0) CHECK(got == approx(expected).epsilon(1e-7));
    t += step;
  }
}

TEST_CASE("the factor of the history shall be that of the law") {
  // 1.5 * 1e-6 * sqrt(pi * 1000 * 1e-3) = 2.6587e-6
  CHECK(basset::factor(1e-3, 1000.0, 1e-3) == approx(2.65868e-6).epsilon(1e-5));
}

}  // namespace

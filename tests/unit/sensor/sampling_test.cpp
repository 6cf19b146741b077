// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/sampling.hpp"

#include "support/approx.hpp"
#include "unit/sensor/coverage.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

using namespace dust;
using test::Coverage;
using test::Dice;

TEST_CASE("a diameter shall belong to the nearest size class") {
  const std::vector<double> classes = {10e-6, 300e-6, 600e-6};
  CHECK(sdk::nearest_class(1e-6, classes) == 0);
  CHECK(sdk::nearest_class(10e-6, classes) == 0);
  CHECK(sdk::nearest_class(301e-6, classes) == 1);
  CHECK(sdk::nearest_class(449e-6, classes) == 1);
  CHECK(sdk::nearest_class(451e-6, classes) == 2);
  CHECK(sdk::nearest_class(1.0, classes) == 2);
  CHECK(sdk::nearest_class(1.0, {}) == 0);
  CHECK(sdk::class_name(300e-6) == "class_300_um");
  CHECK(sdk::class_name(12.5e-6) == "class_12_5_um");
}

TEST_CASE("a passage shall be counted once, wherever a grain rests between two samples") {
  CHECK(sdk::passage(-1, 0).direction == 1);
  CHECK(sdk::passage(0, 1).direction == 0);
  CHECK(sdk::passage(1, 0).direction == 0);
  CHECK(sdk::passage(0, -1).direction == -1);
  CHECK(sdk::passage(-1, 3).fraction == 0.25);
}

TEST_CASE("batch means shall give the exact mean and the error of the scatter") {
  // Errors of independent samples: the deviation over the root of their number.
  Coverage coverage;
  double mean_error = 0.0;
  constexpr int k_samples = 1000;
  for (int run = 0; run < test::k_runs; ++run) {
    Dice dice(run);
    sdk::BatchMeans means(2);
    double sum = 0.0;
    for (int i = 0; i < k_samples; ++i) {
      const double values[] = {dice.normal(), 7.0};
      sum += values[0];
      means.add(values, 0.001);
    }
    CHECK(means.mean(0) == test::approx(sum / k_samples).epsilon(1e-12));
    CHECK(means.mean(1) == test::approx(7.0).epsilon(1e-12));
    CHECK(means.duration() == test::approx(1.0).epsilon(1e-12));
    coverage.add({means.mean(0), "", means.error(0)}, 0.0);
    mean_error += means.error(0) / test::k_runs;
  }
  CHECK(coverage.one() > test::k_one_low);
  CHECK(coverage.one() < test::k_one_high);
  CHECK(coverage.two() > test::k_two_low);
  // Half of all series look as if they remembered, by chance, and have a wider error: by 11 % in
  // the mean of 31 batches.
  CHECK(mean_error == test::approx(1.11 / std::sqrt(k_samples)).epsilon(0.05));
}

TEST_CASE("columns that batch means get later shall have been 0 until then") {
  sdk::BatchMeans whole(2);
  sdk::BatchMeans widened(1);
  for (int i = 0; i < 1000; ++i) {
    const double values[] = {1.0 + i % 7, i < 300 ? 0.0 : 2.0 + i % 3};
    if (i == 300) widened.widen(2);
    whole.add(values, 0.001);
    widened.add(std::span(values, widened.columns()), 0.001);
  }
  for (const std::size_t c : {0u, 1u}) {
    CHECK(widened.mean(c) == whole.mean(c));
    CHECK(widened.error(c) == whole.error(c));
  }
}

TEST_CASE("batch means shall see that neighbouring samples remember each other") {
  // First-order autoregression with memory of 10 samples: the error of the mean is
  // sqrt((1+a)/(1-a)) times that of independent samples, 4.5 for a = 0.905.
  const double a = std::exp(-0.1);
  Coverage coverage;
  for (int run = 0; run < test::k_runs; ++run) {
    Dice dice(run);
    sdk::BatchMeans means(1);
    double state = dice.normal();
    for (int i = 0; i < 8000; ++i) {
      state = a * state + std::sqrt(1.0 - a * a) * dice.normal();
      means.add({&state, 1}, 0.001);
    }
    coverage.add({means.mean(0), "", means.error(0)}, 0.0);
  }
  CHECK(coverage.one() > test::k_one_low - 0.02);  // batches of 256 samples keep a trace of memory
  CHECK(coverage.two() > test::k_two_low);
}

TEST_CASE("a trace of memory that the batches hardly tell from none shall be in the error") {
  // The same process with a memory of 24 samples in 16 batches of 64: they correlate by 0.2, less
  // than what chance does in one series of six, and their own scatter is 0.8 of the error.
  const double a = std::exp(-1.0 / 24.0);
  constexpr int k_samples = 16 * 64;
  double squares = 0.0;
  std::vector<double> errors;
  for (int run = 0; run < test::k_runs; ++run) {
    Dice dice(run);
    sdk::BatchMeans means(1);
    double state = dice.normal();
    for (int i = 0; i < k_samples; ++i) {
      state = a * state + std::sqrt(1.0 - a * a) * dice.normal();
      means.add({&state, 1}, 0.001);
    }
    squares += means.mean(0) * means.mean(0) / test::k_runs;
    if (means.error(0) >= 0.0) errors.push_back(means.error(0));
  }
  CHECK(errors.size() > 0.93 * test::k_runs);
  // The middle one: a few series look as if they remembered long and have errors far too wide.
  std::nth_element(errors.begin(), errors.begin() + test::k_runs / 2, errors.end());
  const double middle = errors[test::k_runs / 2];
  // 300 runs know their scatter to 4 %.
  CHECK(middle > 0.96 * std::sqrt(squares));
  CHECK(middle < 1.3 * std::sqrt(squares));
}

TEST_CASE("memory longer than a batch shall widen the error of the mean") {
  // The same process with a memory of 100 samples seen for 2000: batches of 64 to 125 samples. The
  // scatter of the batches alone would cover the truth in less than half of the runs.
  const double a = std::exp(-0.01);
  Coverage coverage;
  for (int run = 0; run < test::k_runs; ++run) {
    Dice dice(run);
    sdk::BatchMeans means(1);
    double state = dice.normal();
    for (int i = 0; i < 2000; ++i) {
      state = a * state + std::sqrt(1.0 - a * a) * dice.normal();
      means.add({&state, 1}, 0.001);
    }
    coverage.add({means.mean(0), "", means.error(0)}, 0.0);
  }
  const int with_error = coverage.runs - coverage.without_error;
  const double one = static_cast<double>(coverage.within_one) / with_error;
  const double two = static_cast<double>(coverage.within_two) / with_error;
  MESSAGE("within one standard error: " << one << ", two: " << two << ", of " << with_error);
  // A tenth looks like a drift and has none.
  CHECK(with_error > 0.8 * coverage.runs);
  CHECK(one > test::k_one_low);
  CHECK(two > test::k_two_low);
}

TEST_CASE("a mean that drifts, or rests on one lump, shall say that it has not settled") {
  constexpr int k_samples = 1000;
  int drifting = 0, lumped = 0;
  for (int run = 0; run < 100; ++run) {
    Dice dice(run);
    sdk::BatchMeans drift(1), lump(1);
    for (int i = 0; i < k_samples; ++i) {
      const double noise = 0.1 * dice.normal();
      const double rising = noise + static_cast<double>(i) / k_samples;
      const double once = noise + (i >= 700 && i < 900 ? 1.0 : 0.0);
      drift.add({&rising, 1}, 0.001);
      lump.add({&once, 1}, 0.001);
    }
    drifting += drift.error(0) == sdk::k_not_steady;
    lumped += lump.error(0) == sdk::k_not_steady;
  }
  CHECK(drifting == 100);
  CHECK(lumped == 100);
  // A drift below 1 % of the mean is an error: 0.5 % over the time has a deviation of 0.5 /
  // sqrt(12).
  sdk::BatchMeans small(1);
  for (int i = 0; i < 1024; ++i) {
    const double value = 1.0 + 5e-3 * static_cast<double>(i) / 1024.0;
    small.add({&value, 1}, 0.001);
  }
  CHECK(small.error(0) == test::approx(5e-3 / std::sqrt(12.0)).epsilon(0.05));
}

TEST_CASE("the error of a ratio shall leave out what both parts have in common") {
  // A feed that scatters by a third, and 2 mg per g of it that scatter by a hundredth.
  Coverage coverage;
  double error = 0.0, of_mean = 0.0;
  for (int run = 0; run < test::k_runs; ++run) {
    Dice dice(run);
    sdk::BatchMeans means(2);
    for (int i = 0; i < 1024; ++i) {
      const double feed = 1.0 + 0.3 * dice.normal();
      const double values[] = {2e-3 * feed + 2e-5 * dice.normal(), feed};
      means.add(values, 0.001);
    }
    const double ratio = means.mean(0) / means.mean(1);
    coverage.add({ratio, "", means.ratio_error(0, 1)}, 2e-3);
    error += means.ratio_error(0, 1) / test::k_runs;
    of_mean += means.error(0) / test::k_runs;
  }
  CHECK(coverage.without_error == 0);
  CHECK(coverage.one() > test::k_one_low);
  CHECK(coverage.two() > test::k_two_low);
  // 1024 samples; half of all series look as if they remembered, by chance.
  CHECK(error > 0.93 * 2e-5 / 32.0);
  CHECK(error < 1.3 * 2e-5 / 32.0);
  CHECK(of_mean > 25.0 * error);
  sdk::BatchMeans unfed(2);
  const double values[] = {1.0, 0.0};
  for (int i = 0; i < 64; ++i) unfed.add(values, 0.001);
  CHECK(unfed.ratio_error(0, 1) == sdk::k_no_estimate);
}

TEST_CASE("a mean that is not steady shall have no error per load, whatever hides its memory") {
  // The rule of the quotient to first order: what ratio_error would say without the top's own.
  const auto error_of_residuals = [](const sdk::BatchMeans& means) {
    const double ratio = means.mean(0) / means.mean(1);
    const double partials[] = {1.0 / means.mean(1), -ratio / means.mean(1)};
    return means.error_of_function(partials, ratio);
  };
  // Dust that fades by 40 %, over a feed that comes in lumps: its noise is 30 times the drift.
  int hidden = 0;
  for (int run = 0; run < test::k_runs; ++run) {
    Dice dice(run);
    sdk::BatchMeans means(2);
    for (int i = 0; i < 1024; ++i) {
      const double fading = 1.2 - 0.4 * static_cast<double>(i) / 1024.0;
      const double lumps = dice.normal() > 1.5 ? 15.0 : 0.0;
      const double values[] = {fading, lumps};
      means.add(values, 0.001);
    }
    REQUIRE(means.error(0) == sdk::k_not_steady);
    hidden += error_of_residuals(means) > 0.0;
    CHECK(means.ratio_error(0, 1) == sdk::k_not_steady);
  }
  CHECK(hidden > test::k_runs / 2);
  // Where the mean has an error, that of the ratio is the one of the residuals.
  sdk::BatchMeans steady(2);
  Dice dice(1);
  for (int i = 0; i < 1024; ++i) {
    const double feed = 1.0 + 0.3 * dice.normal();
    const double values[] = {2e-3 * feed + 2e-5 * dice.normal(), feed};
    steady.add(values, 0.001);
  }
  REQUIRE(steady.error(0) > 0.0);
  CHECK(steady.ratio_error(0, 1) == test::approx(error_of_residuals(steady)).epsilon(1e-9));
}

TEST_CASE("a feed shall count as even unless it begins, ends or changes while it is watched") {
  const auto fed = [](const std::function<double(int)>& amount) {
    sdk::BatchMeans means(1);
    for (int i = 0; i < 1000; ++i) {
      const double value = amount(i);
      means.add({&value, 1}, 0.001);
    }
    return means;
  };
  CHECK(fed([](int) { return 1.0; }).is_even(0));
  // Grains that come one by one, at most one in a batch.
  CHECK(fed([](int i) { return i % 70 == 60 ? 1.0 : 0.0; }).is_even(0));
  CHECK(fed([](int i) { return 1.0 + 0.5 * std::sin(0.1 * i); }).is_even(0));
  CHECK_FALSE(fed([](int) { return 0.0; }).is_even(0));
  CHECK_FALSE(fed([](int i) { return i < 600 ? 1.0 : 0.0; }).is_even(0));
  CHECK_FALSE(fed([](int i) { return i < 920 ? 1.0 : 0.0; }).is_even(0));
  CHECK_FALSE(fed([](int i) { return i < 300 ? 0.0 : 1.0; }).is_even(0));
  CHECK_FALSE(fed([](int i) { return i < 500 ? 1.0 : 2.0; }).is_even(0));
  CHECK(fed([](int i) { return i < 900 ? 1.0 : 0.0; }).has_ended(0));
  CHECK_FALSE(fed([](int i) { return i < 900 ? 0.0 : 1.0; }).has_ended(0));
  CHECK_FALSE(sdk::BatchMeans(1).is_even(0));
  // Amounts per load: of a batch they are known, of a feed that ends or begins they are not.
  const auto steady = fed([](int) { return 1.0; });
  const auto stopping = fed([](int i) { return i < 600 ? 1.0 : 0.0; });
  const auto beginning = fed([](int i) { return i < 300 ? 0.0 : 1.0; });
  CHECK_FALSE(steady.is_uneven(0, 0.0));
  CHECK_FALSE(steady.is_uneven(0, 3.0));
  CHECK_FALSE(stopping.is_uneven(0, 0.0));
  CHECK(stopping.is_uneven(0, 3.0));
  CHECK(beginning.is_uneven(0, 0.0));
  // What was fed before, and none since, has ended; what has never been fed is no feed.
  CHECK(fed([](int) { return 0.0; }).is_uneven(0, 3.0));
  CHECK_FALSE(fed([](int) { return 0.0; }).is_uneven(0, 0.0));
  CHECK_FALSE(sdk::BatchMeans(1).is_uneven(0, 3.0));
}

TEST_CASE("a mean that rests on what came at the very end shall not be told as exact") {
  // One impact in the last samples, which no batch has closed over: columns 0 and 1 over a load.
  sdk::BatchMeans means(2);
  for (int i = 0; i < 1000; ++i) {
    const double values[] = {i >= 998 ? 5.0 : 0.0, 2.0};
    means.add(values, 0.001);
  }
  REQUIRE(means.mean(0) > 0.0);
  CHECK(means.error(0) == sdk::k_not_steady);
  CHECK(means.ratio_error(0, 1) == sdk::k_not_steady);
  // What is the same all the time is known.
  CHECK(means.error(1) < 1e-12);
  CHECK(means.error(1) >= 0.0);
}

TEST_CASE("few samples shall give no error rather than a wrong one") {
  sdk::BatchMeans means(1);
  const double one = 1.0;
  CHECK(means.error(0) < 0.0);
  CHECK(means.mean(0) == 0.0);
  CHECK(std::isnan(means.known_mean(0)));
  for (int i = 0; i < 7; ++i) means.add({&one, 1}, 1.0);
  CHECK(means.error(0) < 0.0);
  means.add({&one, 1}, 1.0);
  CHECK(means.error(0) == 0.0);
  CHECK(means.known_mean(0) == means.mean(0));
}

TEST_CASE("samples without a value shall not count for the mean of their column") {
  sdk::KnownMeans means(2);
  CHECK(std::isnan(means.mean(0)));
  CHECK(means.error(0) == sdk::k_nothing_passed);
  for (int i = 0; i < 40; ++i) {
    const double values[] = {i % 2 == 0 ? 3.0 : sdk::k_no_value, static_cast<double>(i)};
    means.add(values, 0.5);
  }
  CHECK(means.mean(0) == 3.0);
  CHECK(means.error(0) < 1e-12);
  CHECK(means.error(0) >= 0.0);
  CHECK(means.mean(1) == test::approx(19.5));
}

TEST_CASE("a thinned curve shall stay short and keep its mean") {
  sdk::ThinnedCurve curve;
  constexpr int k_points = 1 << 14;
  for (int i = 0; i < k_points; ++i) curve.add(i, 2.0 * i);
  CHECK(curve.x().size() <= 2048);
  CHECK(curve.x().size() >= 1024);
  double mean = 0.0;
  for (const double y : curve.y()) mean += y / static_cast<double>(curve.y().size());
  CHECK(mean == test::approx(k_points - 1.0).epsilon(1e-9));
}

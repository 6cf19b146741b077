// SPDX-License-Identifier: Apache-2.0
#include "study/calibration/surrogate.hpp"
#include "base/error.hpp"
#include "study/sampling.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using dust::test::approx;
using namespace dust::study;

namespace {

double bend(const std::vector<double>& x) {
  return 3.0 + 2.0 * x[0] - x[1] + std::sin(4.0 * x[0]) * x[1];
}

std::vector<double> values_of(const Sample& places) {
  std::vector<double> values;
  for (const auto& place : places) values.push_back(bend(place));
  return values;
}

}  // namespace

TEST_CASE("a Gaussian process shall pass through runs without scatter and follow between them") {
  const Sample places = sobol(24, 2, 1);
  const auto process = make_gaussian_process();
  process->fit(places, values_of(places));
  for (const auto& place : places) {
    CHECK(process->at(place).mean == approx(bend(place)).epsilon(1e-3));
  }
  double worst = 0.0;
  std::size_t covered = 0;
  const Sample others = latin_hypercube(200, 2, 9);
  for (const auto& place : others) {
    const Prediction p = process->at(place);
    worst = std::max(worst, std::abs(p.mean - bend(place)));
    if (std::abs(p.mean - bend(place)) <= 2.0 * std::sqrt(p.variance) + 1e-6) ++covered;
  }
  // The function spans 4 units; 24 runs of a smooth function leave a few hundredths.
  CHECK(worst < 0.15);
  // Two standard errors should cover 95 %; a factor of two of the misses is allowed.
  CHECK(covered >= 180);
}

TEST_CASE("predictions shall carry the errors of runs that their scatter does not show") {
  // A straight line without scatter through five places of a centred design: the mean of a full
  // quadratic in the middle has the variance e^2 h (B'B)^-1 h, here 17/35 e^2.
  const Sample places = {{0.1}, {0.3}, {0.5}, {0.7}, {0.9}};
  const std::vector<double> values = {0.1, 0.3, 0.5, 0.7, 0.9};
  const std::vector<double> errors(5, 0.2);
  const auto quadratic = make_quadratic();
  quadratic->fit(places, values, errors);
  CHECK(quadratic->at({0.5}).variance == approx(17.0 / 35.0 * 0.04).epsilon(1e-6));
  // One run taken for granted, with the same error, in the same place.
  const double before = quadratic->at({0.5}).variance;
  quadratic->add_virtual_run({0.5});
  CHECK(quadratic->at({0.5}).variance < before);
  const auto process = make_gaussian_process();
  process->fit(places, values, errors);
  CHECK(process->at({0.5}).variance > 0.04 / 5);
  CHECK(process->at({0.5}).variance < 0.04 * 1.01);
  process->fit(places, values);
  CHECK(process->at({0.5}).variance < 1e-4);
}

TEST_CASE("a Gaussian process shall tell scatter of runs from the function") {
  Sample places = sobol(40, 1, 2);
  std::vector<double> values;
  for (std::size_t n = 0; n < places.size(); ++n) {
    // A known scatter of 0.1: alternating signs, without memory along x.
    values.push_back(5.0 * places[n][0] + (n % 2 == 0 ? 0.1 : -0.1));
  }
  const auto process = make_gaussian_process();
  process->fit(places, values);
  CHECK(process->scatter() == approx(0.1).epsilon(0.25));
  CHECK(process->at({0.5}).mean == approx(2.5).epsilon(0.03));
  // The error of the mean is far below the scatter of one run.
  CHECK(std::sqrt(process->at({0.5}).variance) < 0.06);
}

TEST_CASE("a Gaussian process shall know how little it knows from few runs that scatter") {
  // The function spans 4 units. Ten runs in two directions hardly tell scatter from shape.
  for (const std::size_t count : {std::size_t{8}, std::size_t{10}, std::size_t{20}}) {
    for (const double scatter : {0.0, 0.05, 0.2, 0.8}) {
      std::mt19937 random(7);
      std::normal_distribution<double> noise(0.0, 1.0);
      std::size_t covered = 0, asked = 0;
      double learnt = 0.0;
      constexpr int k_studies = 60;
      for (int study = 0; study < k_studies; ++study) {
        const Sample places = sobol(count, 2, static_cast<unsigned>(study + 1));
        std::vector<double> values = values_of(places);
        for (double& v : values) v += scatter * noise(random);
        const auto process = make_gaussian_process();
        process->fit(places, values);
        learnt += process->scatter() / k_studies;
        for (const auto& place : latin_hypercube(20, 2, static_cast<unsigned>(study + 100))) {
          const Prediction p = process->at(place);
          ++asked;
          if (std::abs(p.mean - bend(place)) <= 2.0 * std::sqrt(p.variance)) ++covered;
        }
      }
      CAPTURE(count);
      CAPTURE(scatter);
      CAPTURE(learnt);
      // Two standard errors should cover 95 %; a factor of two of the misses is allowed.
      CHECK(covered >= 0.9 * asked);
      // What is not there is not found; what is, within a third.
      if (scatter >= 0.2) CHECK(learnt == approx(scatter).epsilon(0.35));
      if (scatter == 0.0) CHECK(learnt < 0.2);
    }
  }
}

TEST_CASE("what is taken for granted shall narrow the variance and leave the mean") {
  const Sample places = sobol(12, 2, 1);
  const auto process = make_gaussian_process();
  process->fit(places, values_of(places));
  const std::vector<double> there = {0.93, 0.07};
  const Prediction before = process->at(there);
  process->add_virtual_run(there);
  const Prediction after = process->at(there);
  CHECK(after.mean == approx(before.mean).epsilon(1e-6));
  CHECK(after.variance < 0.2 * before.variance);
}

TEST_CASE("a quadratic surface shall reproduce a quadratic exactly") {
  const Sample places = sobol(16, 2, 1);
  std::vector<double> values;
  const auto surface = [](const std::vector<double>& x) {
    return 1.0 - 2.0 * x[0] + 0.5 * x[1] + 3.0 * x[0] * x[1] - x[1] * x[1];
  };
  for (const auto& place : places) values.push_back(surface(place));
  const auto quadratic = make_quadratic();
  quadratic->fit(places, values);
  for (const auto& place : latin_hypercube(20, 2, 4)) {
    CHECK(quadratic->at(place).mean == approx(surface(place)).epsilon(1e-9));
  }
}

TEST_CASE("too few runs shall be refused") {
  const auto process = make_gaussian_process();
  CHECK_THROWS_AS(process->fit({{0.1, 0.2}, {0.3, 0.4}}, {1.0, 2.0}), dust::base::RunError);
  const auto quadratic = make_quadratic();
  const Sample places = sobol(7, 2, 1);
  CHECK_THROWS_AS(quadratic->fit(places, values_of(places)), dust::base::RunError);
}

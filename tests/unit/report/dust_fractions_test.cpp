// SPDX-License-Identifier: Apache-2.0
#include "report/facts/dust_fractions.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

using dust::report::aerodynamic_diameter;
using dust::report::dust_fractions;
using dust::test::approx;

namespace {

/// The conventions in percent of all airborne dust, computed from their definition apart from the
/// code and rounded to the one decimal place with which the standards table them.
struct Row {
  double diameter;  ///< aerodynamic [um]
  double inhalable, thoracic, respirable;
};
constexpr std::array k_table{
    Row{0, 100.0, 100.0, 100.0}, Row{1, 97.1, 97.1, 97.1}, Row{2, 94.3, 94.3, 91.4},
    Row{3, 91.8, 91.7, 73.9},    Row{4, 89.3, 89.0, 50.0}, Row{5, 87.0, 85.4, 30.0},
    Row{6, 84.9, 80.5, 16.8},    Row{7, 82.9, 74.2, 9.0},  Row{8, 80.9, 66.6, 4.8},
    Row{9, 79.1, 58.3, 2.5},     Row{10, 77.4, 50.0, 1.3}, Row{11, 75.8, 42.1, 0.7},
    Row{12, 74.3, 34.9, 0.4},    Row{13, 72.9, 28.6, 0.2}, Row{14, 71.6, 23.2, 0.1},
    Row{15, 70.3, 18.7, 0.1},    Row{16, 69.1, 15.0, 0.0}, Row{18, 67.0, 9.5, 0.0},
    Row{20, 65.1, 5.9, 0.0},     Row{25, 61.2, 1.8, 0.0},  Row{30, 58.3, 0.6, 0.0},
    Row{35, 56.1, 0.2, 0.0},     Row{40, 54.5, 0.1, 0.0},  Row{50, 52.5, 0.0, 0.0},
    Row{60, 51.4, 0.0, 0.0},     Row{80, 50.4, 0.0, 0.0},  Row{100, 50.1, 0.0, 0.0}};

/// Share of a lognormal distribution above `size`, by Simpson's rule over its density from `size`
/// up: another way to it than the error function of the code.
double share_above(double size, double median, double deviation) {
  const double from = std::log(size / median) / std::log(deviation);
  constexpr double k_end = 9.0;  // beyond lies 1e-19 of it
  constexpr int k_steps = 4000;
  if (from >= k_end) return 0.0;
  const double step = (k_end - from) / k_steps;
  double sum = 0.0;
  for (int n = 0; n <= k_steps; ++n) {
    const double z = from + n * step;
    const double weight = n == 0 || n == k_steps ? 1.0 : n % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::exp(-0.5 * z * z);
  }
  return sum * step / 3.0 / std::sqrt(2.0 * std::numbers::pi);
}

}  // namespace

TEST_CASE("dust conventions shall follow from their definitions at every size") {
  // EN 481: inhalable 50 (1 + exp(-0.06 D)) percent; of that, what a lognormal penetrator of median
  // 11.64 um (thoracic) or 4.25 um (respirable) and geometric deviation 1.5 lets through.
  for (double size = 0.5; size <= 100.0; size += 0.5) {
    INFO("aerodynamic diameter " << size << " um");
    const auto shares = dust_fractions(size * 1e-6);
    const double inhalable = 0.5 * (1.0 + std::exp(-0.06 * size));
    // Simpson's rule with 4000 steps over at most 20 deviations: error below 1e-11.
    constexpr double k_simpson = 1e-10;
    CHECK(std::abs(shares.inhalable - inhalable) < 1e-14);
    CHECK(std::abs(shares.thoracic - inhalable * share_above(size, 11.64, 1.5)) < k_simpson);
    CHECK(std::abs(shares.respirable - inhalable * share_above(size, 4.25, 1.5)) < k_simpson);
    CHECK(shares.respirable <= shares.thoracic);
    CHECK(shares.thoracic <= shares.inhalable);
  }
}

TEST_CASE("dust conventions shall let half through at their medians and be one for the finest") {
  const auto inhalable = [](double um) { return 0.5 * (1.0 + std::exp(-0.06 * um)); };
  CHECK(dust_fractions(11.64e-6).thoracic == approx(0.5 * inhalable(11.64)));
  CHECK(dust_fractions(4.25e-6).respirable == approx(0.5 * inhalable(4.25)));
  // One deviation above the median: the upper tail of the normal distribution, 15.8655 %.
  constexpr double k_tail = 0.15865525393145707;
  CHECK(dust_fractions(1.5 * 11.64e-6).thoracic == approx(k_tail * inhalable(17.46)));
  CHECK(dust_fractions(1.5 * 4.25e-6).respirable == approx(k_tail * inhalable(6.375)));
  // Half of all airborne dust at 10 um (thoracic) and 4 um (respirable), as the standard puts it.
  CHECK(dust_fractions(10e-6).thoracic == approx(0.5).epsilon(0.002));
  CHECK(dust_fractions(4e-6).respirable == approx(0.5).epsilon(0.002));
  CHECK(dust_fractions(0.0).respirable == 1.0);
}

TEST_CASE("dust conventions shall be those of a table with one decimal place") {
  for (const Row& row : k_table) {
    const auto shares = dust_fractions(row.diameter * 1e-6);
    INFO("aerodynamic diameter " << row.diameter << " um");
    constexpr double k_rounding = 0.05 + 1e-9;  // half of the last place
    CHECK(std::abs(100.0 * shares.inhalable - row.inhalable) < k_rounding);
    CHECK(std::abs(100.0 * shares.thoracic - row.thoracic) < k_rounding);
    CHECK(std::abs(100.0 * shares.respirable - row.respirable) < k_rounding);
  }
}

TEST_CASE("dust beyond the conventions shall not be counted in them") {
  CHECK(dust_fractions(100e-6).inhalable > 0.5);
  CHECK(dust_fractions(101e-6).inhalable == 0.0);
  CHECK(dust_fractions(10e-6).pm10 == 1.0);
  CHECK(dust_fractions(10.1e-6).pm10 == 0.0);
}

TEST_CASE("grains of unit density shall be as large as they settle") {
  CHECK(aerodynamic_diameter(7e-6, 1000.0) == approx(7e-6));
  // Quartz: sqrt(2.65) = 1.62788.
  CHECK(aerodynamic_diameter(10e-6, 2650.0) == approx(16.2788e-6).epsilon(1e-5));
}

// SPDX-License-Identifier: Apache-2.0
#include "io/dust_fractions.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

using dust::io::aerodynamic_diameter;
using dust::io::dust_fractions;

namespace {

/// The conventions as tabled in EN 481:1993 and ISO 7708:1995, in percent of all airborne dust.
struct Row {
  double diameter;  ///< aerodynamic [um]
  double inhalable, thoracic, respirable;
};
constexpr std::array k_table{
    Row{0, 100.0, 100.0, 100.0}, Row{1, 97.1, 97.1, 97.1}, Row{2, 94.3, 94.3, 91.4},
    Row{3, 91.7, 91.7, 73.9},    Row{4, 89.3, 89.0, 50.0}, Row{5, 87.0, 85.4, 30.0},
    Row{6, 84.9, 80.5, 16.8},    Row{7, 82.9, 74.2, 9.0},  Row{8, 80.9, 66.6, 4.8},
    Row{9, 79.1, 58.3, 2.5},     Row{10, 77.4, 50.0, 1.3}, Row{11, 75.8, 42.1, 0.7},
    Row{12, 74.3, 34.9, 0.4},    Row{13, 72.9, 28.6, 0.2}, Row{14, 71.6, 23.2, 0.2},
    Row{15, 70.3, 18.7, 0.1},    Row{16, 69.1, 15.0, 0.0}, Row{18, 67.0, 9.5, 0.0},
    Row{20, 65.1, 5.9, 0.0},     Row{25, 61.2, 1.8, 0.0},  Row{30, 58.3, 0.6, 0.0},
    Row{35, 56.1, 0.2, 0.0},     Row{40, 54.5, 0.1, 0.0},  Row{50, 52.5, 0.0, 0.0},
    Row{60, 51.4, 0.0, 0.0},     Row{80, 50.4, 0.0, 0.0},  Row{100, 50.1, 0.0, 0.0}};

}  // namespace

TEST_CASE("dust conventions shall be those of the table of EN 481") {
  for (const Row& row : k_table) {
    const auto shares = dust_fractions(row.diameter * 1e-6);
    INFO("aerodynamic diameter " << row.diameter << " um");
    // The table has one decimal place of a percent, not always rounded to the nearest.
    constexpr double k_rounding = 0.1;
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
  CHECK(aerodynamic_diameter(7e-6, 1000.0) == doctest::Approx(7e-6));
  // Quartz: sqrt(2.65) = 1.62788.
  CHECK(aerodynamic_diameter(10e-6, 2650.0) == doctest::Approx(16.2788e-6).epsilon(1e-5));
}

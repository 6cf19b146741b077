// SPDX-License-Identifier: Apache-2.0
#include "drag/abraham/abraham.hpp"
#include "drag/beetstra/beetstra.hpp"
#include "drag/di_felice/di_felice.hpp"
#include "drag/ergun/ergun.hpp"
#include "drag/gidaspow/gidaspow.hpp"
#include "drag/koch_hill/koch_hill.hpp"
#include "drag/schiller_naumann/schiller_naumann.hpp"
#include "drag/stokes/stokes.hpp"
#include "drag/wen_yu/wen_yu.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

using dust::test::approx;

namespace {

namespace model = dust::model;

// The table gives eight digits; the check asks for six.
constexpr double k_table = 1e-6;

bool is_near(double value, double expected) {
  return std::abs(value - expected) <= k_table * std::abs(expected);
}

TEST_CASE("drag laws shall give the tabulated factors to 1e-6") {
  // Columns: eps, Re, then K / (3 pi mu D) of ergun, wen_yu, gidaspow, di_felice, koch_hill (with
  // 16.14, and with 17.14 as sometimes printed) and beetstra.
  std::ifstream file(DUST_SOURCE "/tests/unit/drag/drag_dimensionless.csv");
  std::string line;
  std::getline(file, line);
  int rows = 0;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    double eps = 0.0;
    double reynolds = 0.0;
    double ergun = 0.0;
    double wen_yu = 0.0;
    double gidaspow = 0.0;
    double di_felice = 0.0;
    double koch_hill = 0.0;
    double koch_hill_17 = 0.0;
    double beetstra = 0.0;
    char comma = 0;
    cells >> eps >> comma >> reynolds >> comma >> ergun >> comma >> wen_yu >> comma >> gidaspow >>
        comma >> di_felice >> comma >> koch_hill >> comma >> koch_hill_17 >> comma >> beetstra;
    CAPTURE(eps);
    CAPTURE(reynolds);
    CHECK(is_near(model::ergun::factor(reynolds, eps), ergun));
    CHECK(is_near(model::wen_yu::factor(reynolds, eps), wen_yu));
    CHECK(is_near(model::gidaspow::factor(reynolds, eps), gidaspow));
    CHECK(is_near(model::di_felice::factor(reynolds, eps), di_felice));
    CHECK(is_near(model::koch_hill::factor(reynolds, eps), koch_hill));
    CHECK(is_near(model::beetstra::factor(reynolds, eps), beetstra));
    ++rows;
  }
  CHECK(rows == 25);
}

TEST_CASE("the drag of a lone slow grain shall be that of Stokes, after Di Felice 0.96 of it") {
  CHECK(model::wen_yu::factor(0.0, 1.0) == 1.0);
  CHECK(model::gidaspow::factor(0.0, 1.0) == 1.0);
  CHECK(model::koch_hill::factor(0.0, 1.0) == 1.0);
  CHECK(model::beetstra::factor(0.0, 1.0) == 1.0);
  CHECK(model::stokes::factor(0.0, 1.0) == 1.0);
  CHECK(model::schiller_naumann::factor(0.0, 1.0) == 1.0);
  CHECK(model::abraham::factor(0.0, 1.0) == 1.0);
  CHECK(model::di_felice::factor(0.0, 1.0) == approx(0.96).epsilon(1e-14));
  // The laws of suspensions come to their limits without a step.
  const double near = 1.0 - 1e-9;
  CHECK(model::koch_hill::factor(1e-9, near) == approx(1.0).epsilon(1e-4));
  CHECK(model::beetstra::factor(1e-9, near) == approx(1.0).epsilon(1e-4));
  CHECK(model::di_felice::factor(1e-9, near) == approx(0.96).epsilon(1e-4));
}

TEST_CASE("laws of one sphere shall see the slip alone, not the void fraction") {
  // Re / eps is the Reynolds number of the interstitial slip.
  for (const double own : {0.01, 3.0, 250.0, 5000.0}) {
    for (const double eps : {0.5, 0.9}) {
      CHECK(model::schiller_naumann::factor(own * eps, eps) ==
            approx(model::schiller_naumann::factor(own, 1.0)).epsilon(1e-12));
      CHECK(model::abraham::factor(own * eps, eps) ==
            approx(model::abraham::factor(own, 1.0)).epsilon(1e-12));
    }
  }
  CHECK(model::abraham::factor(1000.0, 1.0) == approx(0.44 / 24.0 * 1000.0));
  const double abraham = 24.0 / (9.06 * 9.06) * std::pow(1.0 + 9.06 / std::sqrt(40.0), 2);
  CHECK(model::abraham::factor(40.0, 1.0) == approx(abraham * 40.0 / 24.0).epsilon(1e-13));
}

/// Speed [m/s] at which the drag of a lone sphere balances its weight in the fluid, by bisection.
template <class Law>
double terminal_velocity(const Law& law, double diameter, double density, double fluid,
                         double viscosity) {
  const double pi = 3.14159265358979323846;
  const double weight = pi / 6.0 * std::pow(diameter, 3) * (density - fluid) * 9.81;
  double low = 0.0;
  double high = 100.0;
  for (int n = 0; n < 200; ++n) {
    const double speed = 0.5 * (low + high);
    const double reynolds = fluid * speed * diameter / viscosity;
    const double drag = 3.0 * pi * viscosity * diameter * law(reynolds, 1.0) * speed;
    (drag < weight ? low : high) = speed;
  }
  return 0.5 * (low + high);
}

TEST_CASE("V-TERM: the laws shall balance weight at the tabulated terminal velocities") {
  struct Row {
    double diameter, density, fluid, viscosity;
    double stokes, schiller_naumann, abraham, dallavalle, koch_hill, beetstra;
  };
  // terminal_velocity.csv. Dallavalle's coefficient is Di Felice's for a lone sphere.
  const Row rows[] = {
      {1e-3, 2650, 998.2, 0.998e-3, 0.902035, 0.155396, 0.158154, 0.142563, 0.130559, 0.137448},
      {1e-3, 2650, 1.19, 1.84e-5, 78.4566, 7.07532, 6.99847, 6.20482, 5.00971, 5.71471},
      {0.015, 1120, 970, 0.373, 0.049313, 0.0408677, 0.0382873, 0.0381651, 0.0456368, 0.0435476},
      {1e-5, 2650, 1.2139, 1.8e-5, 0.00801994, 0.00798683, 0.00789232, 0.00819344, 0.00801797,
       0.00801731},
      {6e-4, 2650, 1.2139, 1.8e-5, 28.8718, 4.5265, 4.59871, 4.13343, 3.70727, 3.95132}};
  // Six digits in the table; its Stokes and Newton branches end at other Reynolds numbers nowhere.
  constexpr double k_speed = 1e-5;
  for (const Row& r : rows) {
    CAPTURE(r.diameter);
    CAPTURE(r.fluid);
    const auto speed = [&](const auto& law) {
      return terminal_velocity(law, r.diameter, r.density, r.fluid, r.viscosity);
    };
    CHECK(speed(model::stokes::factor) == approx(r.stokes).epsilon(k_speed));
    CHECK(speed(model::schiller_naumann::factor) == approx(r.schiller_naumann).epsilon(k_speed));
    CHECK(speed(model::abraham::factor) == approx(r.abraham).epsilon(k_speed));
    CHECK(speed(model::di_felice::factor) == approx(r.dallavalle).epsilon(k_speed));
    CHECK(speed(model::koch_hill::factor) == approx(r.koch_hill).epsilon(k_speed));
    CHECK(speed([](double re, double eps) { return model::beetstra::factor(re, eps); }) ==
          approx(r.beetstra).epsilon(k_speed));
  }
}

TEST_CASE("the drags of a mixture shall add up to that of its Sauter mean but for the cubic term") {
  // Bidisperse: number fractions n_i. Sum of n_i D_i F_i over the sum of n_i D_i^2 / <D> is F of
  // the mean size, but for 0.064 y^3.
  const double eps = 0.5;
  const double reynolds = 20.0;  // of the Sauter mean
  const double number[2] = {0.8, 0.2};
  const double diameter[2] = {1.0, 2.0};
  double cubes = 0.0;
  double squares = 0.0;
  for (int i = 0; i < 2; ++i) {
    cubes += number[i] * std::pow(diameter[i], 3);
    squares += number[i] * std::pow(diameter[i], 2);
  }
  const double mean = cubes / squares;
  double sum = 0.0;
  double cubic = 0.0;
  for (int i = 0; i < 2; ++i) {
    const double y = diameter[i] / mean;
    sum += number[i] * diameter[i] * model::beetstra::factor(reynolds * y, eps, y);
    cubic += number[i] * diameter[i] * 0.064 * y * y * y;
  }
  const double alike = model::beetstra::factor(reynolds, eps);
  CHECK(sum == approx(alike * (squares / mean + cubic)).epsilon(1e-12));
  CHECK(model::beetstra::factor(reynolds, eps, 1.0) == approx(1.064 * alike).epsilon(1e-12));
}

TEST_CASE("the Gidaspow law shall change branch above a void fraction of exactly 0.8") {
  const double above = std::nextafter(0.8, 1.0);
  CHECK(model::gidaspow::factor(10.0, 0.8) == model::ergun::factor(10.0, 0.8));
  CHECK(model::gidaspow::factor(10.0, above) == model::wen_yu::factor(10.0, above));
  CHECK(model::ergun::factor(10.0, 0.8) != model::wen_yu::factor(10.0, 0.8));
}

TEST_CASE("the Ergun factor shall give the Ergun pressure drop of a bed") {
  const double viscosity = 1.8e-5;
  const double density = 1.2139;
  const double diameter = 6e-4;
  const double pi = 3.14159265358979323846;
  for (const double eps : {0.4, 0.5, 0.7}) {
    for (const double superficial : {0.01, 0.2, 2.0}) {
      const double solids = 1.0 - eps;
      const double reynolds = density * superficial * diameter / viscosity;
      const double force =
          3.0 * pi * viscosity * diameter * model::ergun::factor(reynolds, eps) * superficial / eps;
      const double grains = solids / (pi / 6.0 * std::pow(diameter, 3));  // per bed volume
      // beta w / eps = dp / H
      const double gradient = grains * force / eps;
      const double ergun =
          150.0 * viscosity * solids * solids * superficial /
              (std::pow(eps, 3) * diameter * diameter) +
          1.75 * density * solids * superficial * superficial / (std::pow(eps, 3) * diameter);
      CHECK(gradient == approx(ergun).epsilon(1e-12));
    }
  }
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
#include "drag/ergun/ergun.hpp"
#include "drag/gidaspow/gidaspow.hpp"
#include "drag/wen_yu/wen_yu.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace {

namespace model = dust::model;

// The table gives eight digits; the check asks for six.
constexpr double k_table = 1e-6;

bool is_near(double value, double expected) {
  return std::abs(value - expected) <= k_table * std::abs(expected);
}

TEST_CASE("drag laws shall give the tabulated factors to 1e-6") {
  // Columns: eps, Re, then K / (3 pi mu D) of ergun, wen_yu, gidaspow and laws not offered here.
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
    char comma = 0;
    cells >> eps >> comma >> reynolds >> comma >> ergun >> comma >> wen_yu >> comma >> gidaspow;
    CAPTURE(eps);
    CAPTURE(reynolds);
    CHECK(is_near(model::ergun::factor(reynolds, eps), ergun));
    CHECK(is_near(model::wen_yu::factor(reynolds, eps), wen_yu));
    CHECK(is_near(model::gidaspow::factor(reynolds, eps), gidaspow));
    ++rows;
  }
  CHECK(rows == 25);
}

TEST_CASE("the Wen-Yu drag of a lone slow grain shall be that of Stokes") {
  CHECK(model::wen_yu::factor(0.0, 1.0) == 1.0);
  CHECK(model::gidaspow::factor(0.0, 1.0) == 1.0);
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
      CHECK(gradient == doctest::Approx(ergun).epsilon(1e-12));
    }
  }
}

}  // namespace

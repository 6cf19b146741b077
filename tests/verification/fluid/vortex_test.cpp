// SPDX-License-Identifier: Apache-2.0
#include "fluid_case.hpp"

#include <doctest/doctest.h>
#include <numbers>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_order = 1.9;
constexpr double k_pi = std::numbers::pi;

double taylor_green_error(int n, double step, double nu, double end) {
  Case c;
  c.max = {2 * k_pi, 1, 2 * k_pi};
  c.cells = {n, 1, n};
  c.fluid.density = 1;
  c.fluid.viscosity = nu;
  c.fluid.pressure_tolerance = 1e-8;
  c.fluid.largest_cfl = 10;  // the step is the test's
  c.start();
  const auto field = [](Vec3 x) {
    return Vec3{std::sin(x.x) * std::cos(x.z), 0, -std::cos(x.x) * std::sin(x.z)};
  };
  c.solver->set_velocity(field);
  c.advance_to(end, step);
  double sum = 0.0;
  for (const int d : {0, 2}) {
    c.each_face(d, [&](int, int, int, Vec3 x, double v) {
      sum += std::pow(v - field(x)[d] * std::exp(-2 * nu * end), 2);
    });
  }
  return std::sqrt(sum / (2.0 * n * n));
}

}  // namespace

TEST_CASE("V-TG: the Taylor-Green vortex shall decay as exp(-2 nu t), second order") {
  double last = 0.0;
  for (const int n : {16, 32, 64}) {
    const double e = taylor_green_error(n, 1.6 / n, 0.05, 1.0);
    MESSAGE("cells " << n << " rms error " << e << " order " << (last > 0 ? order(last, e) : 0.0));
    if (last > 0) CHECK(order(last, e) > k_order);
    last = e;
  }
}

TEST_CASE("V-GRESHO: a vortex carried once round the box shall keep 85 % of its peak speed") {
  Case c;
  c.max = {1, 1, 1};
  c.cells = {40, 1, 40};
  c.fluid.density = 1;
  c.fluid.viscosity = 0;
  c.start();
  c.solver->set_velocity([](Vec3 x) {
    const double a = x.x - 0.5;
    const double b = x.z - 0.5;
    const double r = std::hypot(a, b);
    const double speed = r < 0.2 ? 5 * r : r < 0.4 ? 2 - 5 * r : 0.0;
    return r > 0 ? Vec3{1 - speed * b / r, 0, speed * a / r} : Vec3{1, 0, 0};
  });
  const auto peak = [&] {
    double largest = 0.0;
    for (int k = 0; k < 40; ++k) {
      for (int i = 0; i < 40; ++i) {
        const double a = 0.5 * (c.u(0, i, 0, k) + c.u(0, i + 1, 0, k)) - 1;
        const double b = 0.5 * (c.u(2, i, 0, k) + c.u(2, i, 0, k + 1));
        largest = std::max(largest, std::hypot(a, b));
      }
    }
    return largest;
  };
  const double before = peak();
  c.advance_to(1.0, 0.01);
  MESSAGE("peak " << peak() / before << " of " << before);
  CHECK(peak() / before > 0.85);
}

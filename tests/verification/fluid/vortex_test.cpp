// SPDX-License-Identifier: Apache-2.0
#include "fluid_case.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>
#include <numbers>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_order = 1.9;
constexpr double k_pi = std::numbers::pi;

/// The Taylor-Green vortex carried along by a uniform stream: exact at any time.
struct Vortex {
  Vec3 stream;
  double nu = 0.05;

  [[nodiscard]] Vec3 at(Vec3 x, double t) const {
    const double a = x.x - stream.x * t;
    const double b = x.z - stream.z * t;
    const double decay = std::exp(-2 * nu * t);
    return stream + decay * Vec3{std::sin(a) * std::cos(b), 0, -std::cos(a) * std::sin(b)};
  }
};

/// Runs the vortex on n x n cells to `end`.
Case run(const Vortex& vortex, int n, double step, double end) {
  Case c;
  c.max = {2 * k_pi, 1, 2 * k_pi};
  c.cells = {n, 1, n};
  c.fluid.density = 1;
  c.fluid.viscosity = vortex.nu;
  c.fluid.pressure_tolerance = 1e-8;
  c.fluid.largest_cfl = 10;  // the step is the test's
  c.start();
  c.solver->set_velocity([&](Vec3 x) { return vortex.at(x, 0.0); });
  c.advance_to(end, step);
  return c;
}

/// Root mean square over the faces of `of(d, i, j, k, x, u)`.
template <class Of>
double rms(const Case& c, const Of& of) {
  double sum = 0.0;
  for (const int d : {0, 2}) {
    c.each_face(d, [&](int i, int j, int k, Vec3 x, double v) {
      sum += std::pow(of(d, i, j, k, x, v), 2);
    });
  }
  return std::sqrt(sum / (2.0 * c.cells[0] * c.cells[2]));
}

double error_of(const Case& c, const Vortex& vortex) {
  return rms(c,
             [&](int d, int, int, int, Vec3 x, double v) { return v - vortex.at(x, c.time)[d]; });
}

double difference(const Case& a, const Case& b) {
  return rms(a, [&](int d, int i, int j, int k, Vec3, double v) { return v - b.u(d, i, j, k); });
}

}  // namespace

TEST_CASE("V-TG: the Taylor-Green vortex shall decay as exp(-2 nu t), its energy as exp(-4 nu t)") {
  const Vortex vortex;
  double last = 0.0;
  for (const int n : {16, 32, 64}) {
    const Case c = run(vortex, n, 1.6 / n, 1.0);
    const double e = error_of(c, vortex);
    MESSAGE("cells " << n << ", step with the spacing: rms error " << e << " order "
                     << (last > 0 ? order(last, e) : 0.0));
    if (last > 0) CHECK(order(last, e) > k_order);
    last = e;
    if (n != 64) continue;
    const double speed = rms(c, [](int, int, int, int, Vec3, double v) { return v; });
    const double kept = std::pow(2.0 * speed, 2);  // the rms of sin cos is 1/2
    MESSAGE("energy kept " << kept << ", exp(-4 nu t) = " << std::exp(-0.2));
    // The velocity's error, 1e-4, twice.
    CHECK(kept == test::approx(std::exp(-0.2)).epsilon(1e-3));
  }
}

TEST_CASE("V-TG carried along by a stream shall be of second order in space") {
  // The steps are so short that their error is nothing beside the grid's.
  const Vortex vortex{{1.0, 0, 0.5}};
  double last = 0.0;
  for (const int n : {16, 32, 64}) {
    const double e = error_of(run(vortex, n, 1.0 / 512, 0.5), vortex);
    MESSAGE("cells " << n << ", step 1/512: rms error " << e << " order in space "
                     << (last > 0 ? order(last, e) : 0.0));
    if (last > 0) CHECK(order(last, e) > k_order);
    last = e;
  }
}

TEST_CASE("V-TG carried along by a stream shall be of second order in time") {
  // One grid, so that its error cancels in the differences between steps and half steps.
  const Vortex vortex{{1.0, 0, 0.5}};
  const double step = 1.0 / 16;
  const Case a = run(vortex, 32, step, 1.0);
  const Case b = run(vortex, 32, step / 2, 1.0);
  const Case c = run(vortex, 32, step / 4, 1.0);
  const Case d = run(vortex, 32, step / 8, 1.0);
  const double ab = difference(a, b);
  const double bc = difference(b, c);
  const double cd = difference(c, d);
  MESSAGE("differences " << ab << ", " << bc << ", " << cd << ": order in time " << order(ab, bc)
                         << ", " << order(bc, cd));
  CHECK(order(ab, bc) > k_order);
  CHECK(order(bc, cd) > k_order);
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

// SPDX-License-Identifier: Apache-2.0
#include "coupling/self_disturbance/disturbance_formulas.hpp"

#include "coupling/stencils/multi_cell_kernel.hpp"
#include "coupling/stencils/smooth_kernel.hpp"
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace dust;
namespace disturbance = coupling::self_disturbance;
using test::World;
constexpr double k_pi = std::numbers::pi;

/// Weights of the points 0, 1, .. of an axis without end around `place` by a cubic B-spline.
std::vector<double> spline_weights(double place, double knots) {
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -12; i <= 12; ++i) {
    const double x = std::abs(i - place) / knots;
    const double w =
        x < 1 ? 2.0 / 3.0 - x * x + 0.5 * x * x * x : (x < 2 ? std::pow(2 - x, 3) / 6 : 0.0);
    weights.push_back(w);
    sum += w;
  }
  for (double& w : weights) w /= sum;
  return weights;
}
/// |sum w exp(i k x)|^2 of those weights.
double spectrum(const std::vector<double>& weights, double k) {
  double real = 0.0;
  double imaginary = 0.0;
  for (std::size_t n = 0; n < weights.size(); ++n) {
    real += weights[n] * std::cos(k * static_cast<double>(n));
    imaginary += weights[n] * std::sin(k * static_cast<double>(n));
  }
  return real * real + imaginary * imaginary;
}
/// Answer of the discrete Stokes flow on a staggered grid of edge 1, viscosity 1, to a unit force
/// spread and gathered by splines: over the waves of a grid of n cells along each axis with
/// half-wave offsets, so that the longest is not missing. `place` from a face along z, from the
/// middles along x and y.
double discrete_stokes(int n, std::array<double, 3> place, double knots) {
  std::array<std::vector<double>, 3> share;
  std::vector<double> wave;
  for (int i = 0; i < n; ++i) {
    const double k = 2.0 * k_pi * (i + 0.5) / n;
    wave.push_back(4.0 * std::pow(std::sin(0.5 * k), 2));
    for (std::size_t d = 0; d < 3; ++d) {
      share[d].push_back(spectrum(spline_weights(place[d], knots), k));
    }
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < wave.size(); ++k) {
    for (std::size_t j = 0; j < wave.size(); ++j) {
      for (std::size_t i = 0; i < wave.size(); ++i) {
        const double all = wave[i] + wave[j] + wave[k];
        sum += share[0][i] * share[1][j] * share[2][k] * (1.0 - wave[k] / all) / all;
      }
    }
  }
  return sum / (static_cast<double>(n) * n * n);
}

TEST_CASE("what a wall leaves of a grain's own flow shall be that of the grid's Stokes flow") {
  // G / G_0, D/dx and y/dx by tools/validation/wall_mobility.py.
  struct Known {
    bool is_across;
    double diameter, distance, left;
  };
  for (const Known& known :
       {Known{false, 0.5, 0.5, 0.2453}, Known{false, 1.0, 1.0, 0.4359},
        Known{false, 1.5, 4.5, 0.8180}, Known{false, 2.0, 1.0, 0.3194},
        Known{false, 2.0, 4.0, 0.7304}, Known{true, 0.5, 0.5, 0.1372},
        Known{true, 1.0, 1.5, 0.3270}, Known{true, 1.5, 1.5, 0.2660}, Known{true, 2.0, 1.0, 0.1231},
        Known{true, 2.0, 6.0, 0.6364}, Known{true, 2.5, 2.5, 0.2399}}) {
    const double knots = std::max(known.diameter, disturbance::k_min_knots);
    // Across the wall the kernel ends in the halo.
    const double normal = std::min(knots, 0.5 * (known.distance + 2.5));
    const double along = disturbance::kernel_width(knots, 1.0);
    const double width = std::cbrt(along * along * disturbance::kernel_width(normal, 1.0));
    double left = 0.0;
    for (std::size_t n = 0; n < disturbance::k_groups; ++n) {
      left += disturbance::k_shares[n] * disturbance::beside_side(disturbance::Side::wall,
                                                                  known.is_across,
                                                                  disturbance::k_waves[n] / width,
                                                                  {known.distance, knots, 1.0});
    }
    // A hundredth of it is half a per cent of the drag of the largest.
    CHECK(std::abs(left - known.left) < 0.012);
  }
}

TEST_CASE("a grid shall answer to the smooth kernel as a Gaussian does, anywhere in a cell") {
  constexpr double k_answer = 0.005;
  const std::array<double, 3> places[] = {{0, 0, 0}, {0.5, 0.5, 0.5}, {0, 0, 0.5}, {0.3, 0.1, 0.2}};
  for (const double knots : {1.25, 2.0, 3.0}) {
    for (const auto& place : places) {
      CAPTURE(knots);
      // Twice the grid halves the part of the images: linear in 1/n.
      const double limit =
          2.0 * discrete_stokes(48, place, knots) - discrete_stokes(24, place, knots);
      const double formula =
          disturbance::still_mobility(disturbance::kernel_width(knots, 1.0), 1.0);
      CHECK(formula == test::approx(limit).epsilon(k_answer));
    }
  }
}

/// Flow in a Gaussian by a force in it, w along it, over that of slow steady flow; all lengths in
/// sigma, nu = 1.
double oseen(double speed) {
  constexpr int k_steps = 20000;
  constexpr double k_last = 8.0;
  double sum = 0.0;
  for (int n = 0; n < k_steps; ++n) {
    const double k = (n + 0.5) * k_last / k_steps;
    const double p = speed / k;
    double angles = 0.0;
    for (int a = 0; a < 100; ++a) {
      const double x = (a + 0.5) / 100;
      angles += 1.5 * (1 - x * x) / (1 + p * p * x * x) / 100;
    }
    sum += std::exp(-k * k) * angles * k_last / k_steps;
  }
  return sum * 2.0 / std::sqrt(k_pi);
}

TEST_CASE("the groups of waves shall build up as a force in a Gaussian does") {
  const disturbance::Response r = disturbance::response(1.0, 1.0, 1.0, 0.0);
  const double still = disturbance::still_mobility(1.0, 1.0);
  for (const double time : {0.01, 0.1, 1.0, 10.0, 100.0, 1000.0}) {
    double built = 0.0;
    for (std::size_t n = 0; n < disturbance::k_groups; ++n) {
      built += r.mobility[n] / still * (1.0 - std::exp(-r.rate[n] * time));
    }
    CHECK(std::abs(built - (1.0 - 1.0 / std::sqrt(1.0 + time))) < 0.024);
  }
  CHECK(r.stress == test::approx(1.0).epsilon(1e-3));
}

TEST_CASE("the groups of waves shall be carried away by a stream as in Oseen's flow") {
  const double still = disturbance::still_mobility(1.0, 1.0);
  for (const double speed : {0.01, 0.1, 1.0, 3.0, 10.0, 100.0}) {
    CAPTURE(speed);
    const disturbance::Response r = disturbance::response(1.0, 1.0, 1.0, speed);
    double sum = 0.0;
    for (const double part : r.mobility) sum += part / still;
    // Above 10 it is 9 % of little.
    CHECK(sum == test::approx(oseen(speed)).epsilon(speed > 10.0 ? 0.1 : 0.015));
  }
}

TEST_CASE("the excess around a grain shall be the compressibility of hard spheres") {
  const auto pressure = [](double phi) {  // phi Z, Carnahan and Starling
    return phi * (1 + phi + phi * phi - phi * phi * phi) / std::pow(1 - phi, 3);
  };
  CHECK(disturbance::excess_of_one(0.0) == 1.0);
  for (const double phi : {0.01, 0.1, 0.3, 0.5, 0.6}) {
    constexpr double k_change = 1e-6;
    const double slope = (pressure(phi + k_change) - pressure(phi - k_change)) / (2 * k_change);
    CHECK(disturbance::excess_of_one(phi) == test::approx(1.0 / slope).epsilon(1e-6));
  }
}

World::Choice isolated(const std::string& voidage) {
  World::Choice choice;
  choice.max = {0.032, 0.032, 0.032};
  choice.cells = {16, 16, 16};
  choice.voidage = voidage;
  choice.density = 1000.0;
  choice.viscosity = 1e-3;
  choice.disturbance_correction = scenario::DisturbanceCorrection::taken_off;
  return choice;
}

TEST_CASE("a lone grain shall see the void fraction and the slip of the empty fluid") {
  struct Size {
    const char* voidage;
    double diameter;
  };
  for (const Size size :
       {Size{"divided", 1e-3}, Size{"centre", 1e-3}, Size{"big_particle", 5e-3}}) {
    for (const double at : {0.0150, 0.0161, 0.0167}) {
      CAPTURE(std::string(size.voidage));
      CAPTURE(at);
      double seen = 0.0;
      World::Choice choice = isolated(size.voidage);
      choice.factor = [&](double, double eps) { return seen = eps, 1.0; };
      World world(choice);
      world.grains.add({at, 0.0163, 0.0159}, {}, size.diameter);
      world.set(world.velocity, [](sdk::Vec3) { return sdk::Vec3{0, 0, 0.1}; });
      world.begin_step(1e-3);
      CHECK(seen == test::approx(1.0).epsilon(1e-12));
      world.refresh();
      CHECK(seen == test::approx(1.0).epsilon(1e-12));
    }
  }
}

TEST_CASE("the smooth kernel shall sum to one about the grain, and know what is in its way") {
  World::Choice choice = isolated("divided");
  choice.open = [](int i, int, int) { return i == 9 ? 0.4 : 1.0; };
  const World world(choice);
  const coupling::Lattice lattice(world.grid, world.open);
  coupling::SmoothKernel kernel(lattice);
  const double place[] = {0.0091, 0.0094, 0.0107};
  using Room = coupling::SmoothKernel::Room;
  CHECK(kernel.set(place, 1e-3) == Room::open);
  for (int d = 0; d < 3; ++d) {
    double sum = 0.0;
    double centre = 0.0;
    kernel.for_faces(d, [&](std::ptrdiff_t face, double w) {
      const std::array<int, 3> at = lattice.indices(face);
      sum += w;
      centre += w * world.grid.face(d, at[0], at[1], at[2])[d];
    });
    CHECK(sum == test::approx(1.0).epsilon(1e-12));
    CHECK(std::abs(centre - place[d]) < 0.01 * world.grid.spacing[d]);
  }
  // Faces beside the body take part of the kernel, a side of the domain another.
  const double beside_body[] = {0.0141, 0.0094, 0.0107};
  CHECK(kernel.set(beside_body, 1e-3) == Room::none);
  const double beside_side[] = {0.0091, 0.0094, 0.0040};
  CHECK(kernel.set(beside_side, 1e-3) == Room::beside);
}

TEST_CASE("grains larger than a cell shall be coupled over all their cells") {
  const World world(isolated("big_particle"));
  const coupling::Lattice lattice(world.grid, world.open);
  coupling::MultiCellKernel kernel(lattice, *world.voidage);
  CHECK_FALSE(kernel.takes(1e-3));
  CHECK(kernel.takes(1.01e-3));
  const double place[] = {0.0101, 0.0094, 0.0107};
  kernel.set(place, 2.5e-3);
  double sum = 0.0;
  double centre = 0.0;
  coupling::MultiCellStencil s;
  kernel.stencil(0, world.coupling->void_fraction(), s);
  for (std::size_t n = 0; n < coupling::size(s); ++n) sum += s.weight[n];
  for (const auto& share : kernel.shares()) centre += share.weight * (share.i + 0.5) * 2e-3;
  CHECK(sum == test::approx(1.0).epsilon(1e-12));
  // The cells' centres stand for what lies in them.
  CHECK(centre == test::approx(place[0]).epsilon(0.01));
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
#include "coupling/own_disturbance.hpp"

#include "coupling/wide_kernel.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace dust;
namespace own = coupling::own_disturbance;
using test::World;
constexpr double k_pi = std::numbers::pi;

/// Oseen's flow by a force in a ball, by the wave number: the integrals of docs/theory.
struct Oseen {
  double mobility = 0.0;    ///< G mu a
  double solenoidal = 0.0;  ///< share of the solenoidal force that stress balances
};
Oseen oseen(double reynolds) {
  constexpr int k_steps = 200000;
  constexpr double k_last = 2000.0;
  constexpr double k_step = k_last / k_steps;
  double slow = 0.0;
  Oseen sum;
  for (int n = 0; n < k_steps; ++n) {
    const double q = (n + 0.5) * k_step;
    const double f = 3.0 * (std::sin(q) - q * std::cos(q)) / (q * q * q);
    const double ratio = q / reynolds;
    const double angles =
        reynolds > 0.0 ? ((1.0 + ratio * ratio) * 2.0 / ratio * std::atan(1.0 / ratio) - 2.0) /
                             (reynolds * reynolds)
                       : 4.0 / 3.0 / (q * q);
    sum.mobility += f * f * q * q * angles * k_step / (4.0 * k_pi * k_pi);
    sum.solenoidal += f * f * q * q * q * q * angles * k_step;
    slow += f * f * q * q * 4.0 / 3.0 * k_step;
  }
  sum.solenoidal /= slow;
  return sum;
}

/// Mean answer of the discrete Stokes flow on a staggered grid of edge 1, viscosity 1, to a unit
/// force with trilinear weights: over the waves of a periodic grid of 2 n cells along each axis.
double discrete_stokes(int n) {
  double sum = 0.0;
  const auto wave = [&](int i) { return 4.0 * std::pow(std::sin(0.5 * k_pi * (i + 0.5) / n), 2); };
  const auto weight = [&](int i) { return 2.0 / 3.0 + std::cos(k_pi * (i + 0.5) / n) / 3.0; };
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const double all = wave(i) + wave(j) + wave(k);
        sum += weight(i) * weight(j) * weight(k) * (1.0 - wave(i) / all) / all;
      }
    }
  }
  return sum / (static_cast<double>(n) * n * n);
}

TEST_CASE("the flow by a force in a ball shall be that of Oseen") {
  CHECK(own::mobility(2.0, 3.0, 0.0) == doctest::Approx(1.0 / (30.0 * k_pi)));
  for (const double reynolds : {0.01, 0.3, 1.0, 3.0, 10.0, 100.0}) {
    CAPTURE(reynolds);
    const Oseen truth = oseen(reynolds);
    CHECK(own::mobility(1.0, 1.0, reynolds) == doctest::Approx(truth.mobility).epsilon(5e-3));
    CHECK(std::abs(own::stress_share(reynolds) - (1.0 + 2.0 * truth.solenoidal) / 3.0) < 0.04);
  }
}

TEST_CASE("trilinear weights shall answer as a ball of 0.7515 cells") {
  // Half the grid doubles the missing long waves: linear in 1/n.
  const double limit = 2.0 * discrete_stokes(48) - discrete_stokes(24);
  CHECK(own::mobility(own::k_trilinear_radius, 1.0, 0.0) == doctest::Approx(limit).epsilon(2e-3));
}

TEST_CASE("the excess around a grain shall be the compressibility of hard spheres") {
  const auto pressure = [](double phi) {  // phi Z, Carnahan and Starling
    return phi * (1 + phi + phi * phi - phi * phi * phi) / std::pow(1 - phi, 3);
  };
  CHECK(own::excess_of_one(0.0) == 1.0);
  for (const double phi : {0.01, 0.1, 0.3, 0.5, 0.6}) {
    constexpr double k_change = 1e-6;
    const double slope = (pressure(phi + k_change) - pressure(phi - k_change)) / (2 * k_change);
    CHECK(own::excess_of_one(phi) == doctest::Approx(1.0 / slope).epsilon(1e-6));
  }
}

World::Choice lone(const std::string& voidage) {
  World::Choice choice;
  choice.max = {0.02, 0.02, 0.02};
  choice.cells = {10, 10, 10};
  choice.voidage = voidage;
  choice.density = 1000.0;
  choice.viscosity = 1e-3;
  choice.corrects_own_disturbance = true;
  return choice;
}

TEST_CASE("a lone grain shall see the void fraction and the slip of the empty fluid") {
  struct Size {
    const char* voidage;
    double diameter;
  };
  for (const Size size :
       {Size{"divided", 1e-3}, Size{"centre", 1e-3}, Size{"big_particle", 5e-3}}) {
    for (const double at : {0.0090, 0.0101, 0.0107}) {
      CAPTURE(std::string(size.voidage));
      CAPTURE(at);
      double seen = 0.0;
      World::Choice choice = lone(size.voidage);
      choice.factor = [&](double, double eps) { return seen = eps, 1.0; };
      World world(choice);
      world.grains.add({at, 0.0103, 0.0099}, {}, size.diameter);
      world.set(world.velocity, [](sdk::Vec3) { return sdk::Vec3{0, 0, 0.1}; });
      world.coupling->map(world.grains.rows(), 1e-3);
      CHECK(seen == doctest::Approx(1.0).epsilon(1e-12));
      world.coupling->refresh(world.grains.rows(), world.velocity, world.stress);
      CHECK(seen == doctest::Approx(1.0).epsilon(1e-12));
    }
  }
}

TEST_CASE("grains larger than a cell shall be coupled over all their cells") {
  const World world(lone("big_particle"));
  const coupling::Lattice lattice(world.grid, world.open);
  coupling::WideKernel kernel(lattice, *world.voidage);
  CHECK_FALSE(kernel.takes(1e-3));
  CHECK(kernel.takes(1.01e-3));
  const double place[] = {0.0101, 0.0094, 0.0107};
  kernel.set(place, 2.5e-3);
  double sum = 0.0;
  double centre = 0.0;
  coupling::WideStencil s;
  kernel.stencil(0, world.coupling->void_fraction(), s);
  for (std::size_t n = 0; n < s.size(); ++n) sum += s.weight[n];
  for (const auto& share : kernel.shares()) centre += share.weight * (share.i + 0.5) * 2e-3;
  CHECK(sum == doctest::Approx(1.0).epsilon(1e-12));
  // The cells' centres stand for what lies in them.
  CHECK(centre == doctest::Approx(place[0]).epsilon(0.01));
  // A ball of twice the volume, smeared over cells.
  CHECK(kernel.ball_radius() == doctest::Approx(2.5e-3 * std::cbrt(2.0)).epsilon(0.1));
}

}  // namespace

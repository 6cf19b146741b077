// SPDX-License-Identifier: Apache-2.0
#include "airborne/near_wall.hpp"
#include "airborne/dust_field.hpp"
#include "dust/sdk/wind_erosion.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

using namespace dust;
using airborne::deposition_velocity;
using airborne::DustClass;
using airborne::DustField;
using airborne::Flow;
using fluid::Grid;

namespace {

constexpr double k_viscosity = 1.5e-5;  // m2/s
constexpr double k_gravity = 9.81;
constexpr double k_area = 0.04 * 0.04;
const airborne::Gas k_gas{1.2, k_viscosity * 1.2};

/// Dust in a still box of 4 x 4 x 4 cells with walls all round, and the floor's friction velocity.
struct Floor {
  Grid grid = Grid::make({0, 0, 0}, {0.04, 0.04, 0.04}, {4, 4, 4}, {false, false, false});
  Flow flow{grid};
  scenario::DustFieldSpec spec;
  double time = 0.0;

  Floor() {
    spec.diameters = {20e-6};
    spec.density = 2650;
    spec.resuspension = {1e-3, 3e-4};
    spec.clouds = {{"cloud", {0, 0, 0}, {0.04, 0.04, 0.01}, {0.5}}};
    for (int k = 0; k < 4; ++k) {
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          const auto cell = static_cast<std::size_t>(grid.index(i, j, k));
          flow.volume_before[cell] = flow.volume_after[cell] = 1.0;
          if (i > 0) flow.passage.component[0][cell] = 1.0;
          if (j > 0) flow.passage.component[1][cell] = 1.0;
          if (k > 0) flow.passage.component[2][cell] = 1.0;
          if (k > 0) continue;
          flow.walls.push_back({static_cast<std::int32_t>(cell), 4, {0, 0, -1.0 / grid.spacing.z}});
        }
      }
    }
    blow(0.0);
  }
  void blow(double friction_velocity) {
    flow.friction_velocity.assign(flow.walls.size(), friction_velocity);
  }
  [[nodiscard]] DustField field() const {
    DustField made(grid, spec, k_gas, {0, 0, -k_gravity}, {0, 6});
    made.start(flow.volume_after);
    return made;
  }
  void run(DustField& field, int steps, double step) {
    for (int n = 0; n < steps; ++n, time += step) field.advance(flow, time, step);
  }
};

}  // namespace

TEST_CASE("what lies shall come off as the law asks for, and no more than lies there") {
  Floor floor;
  DustField field = floor.field();
  floor.run(field, 40, 0.05);
  const double lies = field.balance(0).surfaces[4];
  // All but the tail that a first-order cell keeps.
  REQUIRE(lies > 0.99 * field.balance(0).released);
  const double threshold = sdk::wind_erosion::threshold(20e-6, 2650, 1.2, 3e-4, k_gravity);
  CHECK(threshold == test::approx(0.399).epsilon(1e-3));

  floor.blow(0.99 * threshold);
  floor.run(field, 10, 0.05);
  CHECK(field.balance(0).resuspended == 0.0);

  // F = alpha rho/g u^3 (1 - u_t^2/u^2), for 10 steps.
  floor.blow(0.6);
  floor.run(field, 10, 0.05);
  const double flux = 1e-3 * 1.2 / k_gravity * 0.216 * (1.0 - threshold * threshold / 0.36);
  CHECK(field.balance(0).resuspended == test::approx(flux * k_area * 0.5).epsilon(1e-12));
  CHECK(std::abs(field.balance(0).error()) < 1e-12);

  // Ten thousand times as much as lies there.
  floor.blow(20.0);
  const double before = field.balance(0).resuspended;
  const double left = field.balance(0).surfaces[4];
  floor.run(field, 1, 0.05);
  CHECK(field.balance(0).resuspended - before == test::approx(left).epsilon(1e-12));
  CHECK(std::abs(field.balance(0).error()) < 1e-12);
}

TEST_CASE("classes shall come off by the share that they make of what lies") {
  Floor floor;
  floor.spec.diameters = {20e-6, 40e-6};
  floor.spec.clouds[0].concentration = {0.1, 0.3};
  DustField field = floor.field();
  floor.run(field, 60, 0.05);
  floor.blow(0.6);
  floor.run(field, 1, 0.01);
  const auto flux = [](double diameter) {
    const double threshold = sdk::wind_erosion::threshold(diameter, 2650, 1.2, 3e-4, k_gravity);
    return sdk::wind_erosion::flux(0.6, threshold, 1.2, 1e-3, k_gravity);
  };
  CHECK(field.balance(0).resuspended ==
        test::approx(0.25 * flux(20e-6) * k_area * 0.01).epsilon(0.02));
  CHECK(field.balance(1).resuspended ==
        test::approx(0.75 * flux(40e-6) * k_area * 0.01).epsilon(0.02));
}

TEST_CASE("the friction velocity shall be that of the sublayer, and of the power law beyond") {
  // u_*^2 = nu u / y; continuous where the two meet, at u y / nu = 11.81^2.
  CHECK(airborne::friction_velocity(0.5, 1e-3, k_viscosity) ==
        test::approx(std::sqrt(k_viscosity * 0.5 / 1e-3)));
  const double edge = 11.81 * 11.81 * k_viscosity / 1e-3;
  CHECK(airborne::friction_velocity(1.0001 * edge, 1e-3, k_viscosity) ==
        test::approx(airborne::friction_velocity(0.9999 * edge, 1e-3, k_viscosity)).epsilon(2e-3));
  // u+ = 8.3 y+^(1/7) holds for what comes out.
  const double u = airborne::friction_velocity(10.0, 5e-3, k_viscosity);
  CHECK(10.0 / u == test::approx(8.3 * std::pow(u * 5e-3 / k_viscosity, 1.0 / 7.0)));
  CHECK(airborne::friction_velocity(0.0, 1e-3, k_viscosity) == 0.0);
}

TEST_CASE("deposition on smooth walls shall be that of the three layers at the wall") {
  for (const double diameter : {0.1e-6, 1e-6, 10e-6}) {
    for (const double u : {0.01, 0.1, 0.5}) {
      CAPTURE(diameter);
      CAPTURE(u);
      const DustClass dust = airborne::make_class(diameter, 1000, {0, 0, -k_gravity}, k_gas);
      // Eddy viscosity 7.669e-4 y^3 up to y+ = 4.3, 1e-3 y^2.8214 to 12.5, 1.07e-2 y^1.8895 to 30
      // (Lai and Nazaroff, table 1); Simpson's rule in the logarithm of the inner layer.
      const double brownian = dust.diffusivity / k_viscosity;
      const double radius = 0.5 * diameter * u / k_viscosity;
      constexpr int k_parts = 4000;
      const double h = std::log(4.3 / radius) / k_parts;
      double integral = 0.0;
      for (int n = 0; n <= k_parts; ++n) {
        const double y = radius * std::exp(n * h);
        const double weight = n == 0 || n == k_parts ? 1.0 : (n % 2 != 0 ? 4.0 : 2.0);
        integral += weight * h / 3.0 * y / (7.669e-4 * y * y * y + brownian);
      }
      integral += (std::pow(4.3, -1.8214) - std::pow(12.5, -1.8214)) / (1e-3 * 1.8214);
      integral += (std::pow(12.5, -0.8895) - std::pow(30.0, -0.8895)) / (1.07e-2 * 0.8895);
      const double vertical = deposition_velocity(dust, 0.0, u, k_viscosity);
      // The law's published constants have three digits.
      CHECK(vertical == test::approx(u / integral).epsilon(3e-3));
      const double w = norm(dust.drift);
      const double up = deposition_velocity(dust, w, u, k_viscosity);
      const double down = deposition_velocity(dust, -w, u, k_viscosity);
      CHECK(up - down == test::approx(w).epsilon(1e-9));
      CHECK(up >= vertical);
      CHECK(down <= vertical);
    }
  }
  const DustClass sand = airborne::make_class(10e-6, 2650, {0, 0, -k_gravity}, k_gas);
  CHECK(deposition_velocity(sand, norm(sand.drift), 0.0, k_viscosity) == norm(sand.drift));
  CHECK(deposition_velocity(sand, -norm(sand.drift), 0.0, k_viscosity) == 0.0);
}

TEST_CASE("turbulence shall bring dust to smooth walls besides what settles") {
  Floor floor;
  floor.spec.diameters = {0.05e-6};
  floor.spec.resuspension.reset();
  floor.spec.clouds = {{"cloud", {0, 0, 0}, {0.04, 0.04, 0.04}, {1e-3}}};
  floor.blow(0.5);
  DustField settling = floor.field();
  floor.run(settling, 1, 1e-3);
  floor.flow.smooth_wall_viscosity = k_viscosity;
  DustField turbulent = floor.field();
  floor.run(turbulent, 1, 1e-3);
  const DustClass& dust = turbulent.dust_class(0);
  const double v = deposition_velocity(dust, norm(dust.drift), 0.5, k_viscosity);
  CHECK(turbulent.balance(0).surfaces[4] == test::approx(1e-3 * v * k_area * 1e-3).epsilon(0.01));
  CHECK(settling.balance(0).surfaces[4] ==
        test::approx(1e-3 * norm(dust.drift) * k_area * 1e-3).epsilon(0.01));
  CHECK(turbulent.balance(0).surfaces[4] > 10.0 * settling.balance(0).surfaces[4]);
  CHECK(std::abs(turbulent.balance(0).error()) < 1e-12);
}

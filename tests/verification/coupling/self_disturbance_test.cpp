// SPDX-License-Identifier: Apache-2.0
#include "two_way.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

// A lone grain in an open fluid must feel the law's drag at the undisturbed slip, whatever the size
// of the cells and wherever in one it stands. The box is periodic: what its own images do to it is
// taken off in closed form.
namespace {

using namespace dust;
using test::TwoWay;
using test::World;

constexpr double k_pi = std::numbers::pi;

struct Fluid {
  const char* name;
  double density, viscosity;
};
constexpr Fluid k_air{"air", 1.2139, 1.8e-5};
constexpr Fluid k_water{"water", 998.2, 0.998e-3};

/// Drag of one sphere after Schiller and Naumann (1935), to which wen_yu tends without neighbours.
double law(double diameter, const Fluid& fluid, double slip) {
  const double re = fluid.density * slip * diameter / fluid.viscosity;
  const double factor = re < 1000.0 ? 1.0 + 0.15 * std::pow(re, 0.687) : 0.44 / 24.0 * re;
  return 3.0 * k_pi * fluid.viscosity * diameter * factor * slip;
}
double terminal_speed(double diameter, const Fluid& fluid, double density = test::k_sand) {
  const double weight =
      (density - fluid.density) * TwoWay::k_gravity * sdk::sphere_volume(diameter);
  double low = 0.0;
  double high = 100.0;
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (low + high);
    (law(diameter, fluid, middle) < weight ? low : high) = middle;
  }
  return low;
}

/// Velocity [m/s] per force [N] that the images of a force in a periodic box take from the one at
/// its place after the time t: Oseen's unsteady flow in free space less that in the box. The width
/// of the force hardly matters, for all short waves are in both.
double part_of_images(const Fluid& fluid, double side, double speed, double width, double time) {
  const double nu = fluid.viscosity / fluid.density;
  const auto built_up = [&](double k2, double along) {
    const double a = nu * k2;
    const double b = speed * along;
    const double fades = std::exp(-a * time);
    return (a - fades * (a * std::cos(b * time) - b * std::sin(b * time))) / (a * a + b * b);
  };
  constexpr double k_reach = 5.0;
  double free = 0.0;
  constexpr int k_radial = 4000;
  constexpr int k_angles = 64;
  const double dk = k_reach / width / k_radial;
  for (int r = 0; r < k_radial; ++r) {
    const double k = (r + 0.5) * dk;
    for (int a = 0; a < k_angles; ++a) {
      const double x = (a + 0.5) / k_angles;
      free += k * k * std::exp(-k * k * width * width) * (1.0 - x * x) * built_up(k * k, k * x);
    }
  }
  free *= 2.0 * dk / k_angles / (4.0 * k_pi * k_pi);
  double box = 0.0;
  const double first = 2.0 * k_pi / side;
  const int most = static_cast<int>(k_reach / width / first) + 1;
  for (int k = 0; k <= most; ++k) {
    for (int j = 0; j <= most; ++j) {
      for (int i = 0; i <= most; ++i) {
        if (i + j + k == 0) continue;
        const double k2 = first * first * (i * i + j * j + k * k);
        const double twins = (i > 0 ? 2 : 1) * (j > 0 ? 2 : 1) * (k > 0 ? 2 : 1);
        const double along = first * k;
        box += twins * std::exp(-k2 * width * width) * (1.0 - along * along / k2) *
               built_up(k2, along);
      }
    }
  }
  box /= side * side * side;
  return (free - box) / fluid.density;
}

struct Setting {
  double diameter;  ///< [m]
  double ratio;     ///< D/dx
  Fluid fluid;
  sdk::Vec3 place;             ///< in the cell, 0..1
  bool is_towed = false;       ///< along z through still fluid, else held in a stream
  const char* voidage = nullptr;
  const char* set = "I";
};
/// Error of the drag, least and largest in the last part of the run.
struct Error {
  double least = 1e9;
  double largest = -1e9;
  double mean = 0.0;
  int count = 0;
};

double mean_velocity(const TwoWay& run, int d) {
  double sum = 0.0;
  run.world.for_cells([&](int i, int j, int k) {
    sum += run.world.face_void_fraction(d, i, j, k) *
           run.world.velocity.component[d][run.world.grid.index(i, j, k)];
  });
  return sum / (static_cast<double>(run.world.grid.count[0]) * run.world.grid.count[1] *
                run.world.grid.count[2]);
}

Error drag_error(const Setting& s) {
  static const int k_cells = std::getenv("CELLS") ? std::atoi(std::getenv("CELLS")) : 20;
  static const double k_courant = std::getenv("CO") ? std::atof(std::getenv("CO")) : 0.3;
  const double cell = s.diameter / s.ratio;
  const double side = k_cells * cell;
  const double speed = terminal_speed(s.diameter, s.fluid);
  const double nu = s.fluid.viscosity / s.fluid.density;
  const double width = 0.7 * cell;
  const double end = std::min(0.8 * side / speed, 30.0 * width * width / nu);
  const int steps = std::max(40, static_cast<int>(std::ceil(end * speed / (k_courant * cell))));
  World::Choice choice;
  choice.max = {side, side, side};
  choice.cells = {k_cells, k_cells, k_cells};
  choice.periodic = {true, true, true};
  choice.drag = "wen_yu";
  choice.voidage = s.voidage ? s.voidage : s.ratio > 0.5 ? "big_particle" : "divided";
  choice.momentum_set = s.set;
  choice.density = s.fluid.density;
  choice.viscosity = s.fluid.viscosity;
  choice.fluid_step = end / steps;
  if (const char* mode = std::getenv("SELF")) choice.own_disturbance = mode[0] == '1' ? scenario::OwnDisturbance::automatic : scenario::OwnDisturbance::felt;
  TwoWay run(choice, {}, {}, 1e-6);
  sdk::Vec3 at = s.place;
  for (int d = 0; d < 3; ++d) at[d] = (k_cells / 2 - 1 + at[d]) * cell;
  run.world.grains.add(at, {0, 0, s.is_towed ? -speed : 0.0}, s.diameter, test::k_sand);
  if (!s.is_towed) run.solver->set_velocity([&](sdk::Vec3) { return sdk::Vec3{0, 0, speed}; });
  Error error;
  double* position = run.world.grains.position.data();
  for (int n = 0; n < steps; ++n) {
    coupling::Coupling& coupling = *run.world.coupling;
    const double length = choice.fluid_step;
    if (n == 0) coupling.map(run.world.grains.rows(), length);
    coupling.map(run.world.grains.rows(), length);
    run.solver->advance(run.time, length, coupling.void_fraction_before(), coupling.void_fraction(),
                        coupling.exchange());
    run.time += length;
    coupling.settle(run.world.grains.rows(), run.solver->drag_velocity());
    run.hold_fluid();
    const int refreshes = static_cast<int>(std::lround(length / coupling.refresh_interval()));
    double force = 0.0;
    for (int r = 0; r < refreshes; ++r) {
      coupling.refresh(run.world.grains.rows(), run.world.velocity, run.world.stress);
      const double before = run.world.grains.impulse[2];
      run.world.grains.hold(length / refreshes);
      force += (run.world.grains.impulse[2] - before) / length;
      if (s.is_towed) position[2] -= speed * length / refreshes;
    }
    coupling.collect(run.world.grains.rows(), length);
    if (3 * n < 2 * steps) continue;
    const double slip = mean_velocity(run, 2) - (s.is_towed ? -speed : 0.0);
    const double images = part_of_images(s.fluid, side, speed, width, run.time);
    const double e = force / law(s.diameter, s.fluid, slip + images * force) - 1.0;
    error.least = std::min(error.least, e);
    error.largest = std::max(error.largest, e);
    error.mean += (e - error.mean) / ++error.count;
    if (!s.is_towed) n = steps - 2 > n ? steps - 2 : n;
  }
  return error;
}

TEST_CASE("sweep") {
  const std::vector<double> diameters{20e-6, 100e-6, 300e-6, 1e-3, 3e-3};
  const sdk::Vec3 places[] = {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.0}, {0.0, 0.5, 0.5},
                              {0.0, 0.0, 0.5}, {0.0, 0.0, 0.0}, {0.21, 0.37, 0.68}};
  for (const Fluid& fluid : {k_air, k_water}) {
    for (const double diameter : diameters) {
      if (std::getenv("ONLY") && std::atof(std::getenv("ONLY")) != 1e6 * diameter) continue;
      for (const double ratio : {0.05, 0.1, 0.25, 0.5, 1.0, 2.0}) {
        std::string line;
        char buffer[200];
        double low = 1e9, high = -1e9;
        for (const sdk::Vec3& place : places) {
          const Error e = drag_error({diameter, ratio, fluid, place});
          std::snprintf(buffer, sizeof buffer, " %+6.1f", 100 * e.largest);
          line += buffer;
          low = std::min(low, e.largest);
          high = std::max(high, e.largest);
        }
        const Error e = drag_error({diameter, ratio, fluid, places[5], true});
        std::printf("%s D %g um D/dx %g w %.3g Re %.3g: held%s | towed %+.1f .. %+.1f, mean %+.1f\n", fluid.name,
                    1e6 * diameter, ratio, terminal_speed(diameter, fluid),
                    fluid.density * terminal_speed(diameter, fluid) * diameter / fluid.viscosity,
                    line.c_str(), 100 * e.least, 100 * e.largest, 100 * e.mean);
        std::fflush(stdout);
      }
    }
  }
}

}  // namespace

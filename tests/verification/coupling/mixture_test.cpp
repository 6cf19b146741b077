// SPDX-License-Identifier: Apache-2.0
// V-BED-PSD: a bed of one size against a bed of the thesis's sand.
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace dust;
using test::World;

struct Size {
  double diameter;  // [m]
  double share;     // of the mass
};
const std::vector<Size> k_sand_sizes{
    {300e-6, 0.0621}, {425e-6, 0.1829}, {500e-6, 0.2605}, {600e-6, 0.4945}};
const std::vector<Size> k_one_size{{600e-6, 1.0}};

constexpr double k_void = 0.435;   // of the thesis's bed
constexpr double k_width = 0.015;  // [m]
constexpr double k_height = 0.02;  // of the bed, on the floor of a duct twice as high
constexpr double k_per_l_min = 1.0 / 60000.0 / (0.2 * 0.015);  // [m/s], the thesis's vessel

/// Sizes in their proportion by number, spread evenly over the bed by the golden section.
struct Mixture {
  explicit Mixture(const std::vector<Size>& sizes) : all(sizes) {
    double total = 0.0;
    for (const Size& s : all) total += s.share / std::pow(s.diameter, 3);
    double sum = 0.0;
    for (const Size& s : all) {
      sum += s.share / std::pow(s.diameter, 3) / total;
      until.push_back(sum);
      mean_volume += s.share / std::pow(s.diameter, 3) / total * sdk::sphere_volume(s.diameter);
    }
  }
  [[nodiscard]] double diameter(int n) const {
    const double x = std::fmod((n + 0.5) * (std::numbers::phi - 1.0), 1.0);
    std::size_t at = 0;
    while (at + 1 < until.size() && x >= until[at]) ++at;
    return all[at].diameter;
  }
  std::vector<Size> all;
  std::vector<double> until;
  double mean_volume = 0.0;
};

/// Ergun's pressure gradient [Pa/m], each size with its own drag.
double ergun(const std::vector<Size>& sizes, double velocity) {
  const double solids = 1.0 - k_void;
  const double eps3 = k_void * k_void * k_void;
  double sum = 0.0;
  for (const Size& s : sizes) {
    sum += s.share * (150 * test::k_air_viscosity * solids * solids * velocity /
                          (eps3 * s.diameter * s.diameter) +
                      1.75 * test::k_air * solids * velocity * velocity / (eps3 * s.diameter));
  }
  return sum;
}

/// Pressure drop [Pa] of k_height of the held bed at a superficial velocity.
double drop(const std::vector<Size>& sizes, double velocity) {
  const Mixture mixture(sizes);
  const double pitch = std::cbrt(mixture.mean_volume / (1.0 - k_void));
  const int across = static_cast<int>(std::lround(k_width / pitch));
  const int layers = static_cast<int>(std::lround(k_height / pitch));
  const double side = k_width / across;
  // Whole layers at the wanted void fraction; the cells are fitted to the bed.
  const double height =
      layers * across * across * mixture.mean_volume / (1.0 - k_void) / k_width / k_width;
  World::Choice choice;
  choice.max = {k_width, k_width, 2 * height};
  choice.cells = {3, 3, 8};
  choice.drag = "gidaspow";
  World world(choice);
  for (int n = 0; n < across * across * layers; ++n) {
    world.grains.add({(n % across + 0.5) * side, (n / across % across + 0.5) * side,
                      (n / across / across + 0.5) * height / layers},
                     {}, mixture.diameter(n));
  }
  constexpr double k_step = 1e-3;
  double sum = 0.0;
  // The first steps do not know the slip yet and pay debts.
  for (int step = 0; step < 5; ++step) {
    world.begin_step(k_step);
    for (int k = -1; k <= choice.cells[2] + 1; ++k) {
      for (int j = -1; j <= choice.cells[1]; ++j) {
        for (int i = -1; i <= choice.cells[0]; ++i) {
          world.velocity.component[2][world.grid.index(i, j, k)] =
              velocity / world.face_void_fraction(2, i, j, k);
        }
      }
    }
    world.refresh();
    sum = 0.0;
    world.for_cells([&](int i, int j, int k) {
      const std::ptrdiff_t f = world.grid.index(i, j, k);
      sum +=
          world.coupling->exchange().coefficient.component[2][f] * world.velocity.component[2][f] -
          world.coupling->exchange().source.component[2][f];
    });
    world.grains.hold(k_step);
    world.end_step();
  }
  return sum * world.grid.spacing.z / (choice.cells[0] * choice.cells[1]) / height * k_height;
}

/// Superficial velocity at which a u + b u^2, through the drops at two velocities, is the weight.
double fluidisation(const std::vector<Size>& sizes) {
  constexpr double k_low = 0.1;
  constexpr double k_high = 0.3;
  const double low = drop(sizes, k_low) / k_low;
  const double high = drop(sizes, k_high) / k_high;
  const double b = (high - low) / (k_high - k_low);
  const double a = low - b * k_low;
  const double weight = (1.0 - k_void) * (test::k_sand - test::k_air) * 9.81 * k_height;
  return (-a + std::sqrt(a * a + 4.0 * b * weight)) / (2.0 * b);
}

// What a random bed may be off by: the grains' volume differs from cell to cell.
constexpr double k_random = 0.03;

TEST_CASE("V-BED-PSD: sand shall cost more than grains of its largest size, and rise sooner") {
  const double weight = (1.0 - k_void) * (test::k_sand - test::k_air) * 9.81 * k_height;
  const double speed = 50.0 * k_per_l_min;
  const double sand = drop(k_sand_sizes, speed);
  const double one = drop(k_one_size, speed);
  CHECK(sand == test::approx(ergun(k_sand_sizes, speed) * k_height).epsilon(k_random));
  CHECK(one == test::approx(ergun(k_one_size, speed) * k_height).epsilon(k_random));
  MESSAGE("at 50 l/min over the weight: sand " << sand / weight << ", 0.6 mm " << one / weight);
  CHECK(one < 0.8 * weight);  // far from rising
  CHECK(sand > 0.9 * weight);
  const double ratio = fluidisation(k_one_size) / fluidisation(k_sand_sizes);
  MESSAGE("minimum fluidisation, one size over sand: " << ratio << ", predicted 1.35");
  CHECK(ratio == test::approx(1.35).epsilon(k_random));
}

}  // namespace

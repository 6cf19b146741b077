// SPDX-License-Identifier: Apache-2.0
// Minutes: by its label, `ctest --test-dir build/release -L validation -R plume`.
#include "contract/plugin_library.hpp"
#include "dusty_case.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_density = 1.2;
constexpr double k_cell = 0.0125;
constexpr std::array<int, 3> k_cells{44, 44, 64};
constexpr double k_flow = 2e-4;  ///< [kg/s] of dust
constexpr double k_step = 5e-3;

/// Fines that are set free below the ceiling of an open room, and the air that they draw along.
DustyCase plume() {
  DustyCase c;
  c.air.max = {k_cells[0] * k_cell, k_cells[1] * k_cell, k_cells[2] * k_cell};
  c.air.cells = k_cells;
  c.air.fluid.density = k_density;
  c.air.fluid.viscosity = 1.8e-5;
  for (std::size_t side = 0; side < 5; ++side) c.air.sides[side] = open_side(0.0, true);
  c.air.sides[5] = slip();
  c.spec.diameters = {3e-6};  // sinks by 0.7 mm/s
  c.spec.density = 2650.0;
  scenario::DustSourceSpec source;
  source.name = "stream";
  const double middle = 0.5 * c.air.max.x;
  const double top = c.air.max.z;
  source.min = {middle - 0.025, middle - 0.025, top - 0.025};
  source.max = {middle + 0.025, middle + 0.025, top};
  source.mass_flow = {k_flow};
  source.end = 1e9;
  c.spec.sources = {source};
  return c;
}

/// Fit of log y over log x by least squares.
struct PowerLaw {
  double factor, exponent;
};
PowerLaw fit(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double a = std::log(x[k]);
    const double b = std::log(y[k]);
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {std::exp((sy - slope * sx) / n), slope};
}

}  // namespace

TEST_CASE("a falling stream of fines shall draw air along as a plume: Q = C B^(1/3) z^(5/3)") {
  DustyCase c = plume();
  c.start();
  // A breath of disorder, or the plume would stay as smooth as its source.
  std::uint32_t state = 1;
  c.air.solver->set_velocity([&](Vec3) {
    const auto next = [&] {
      state = 1664525U * state + 1013904223U;
      return 0.02 * (state / 4294967296.0 - 0.5);
    };
    return Vec3{next(), next(), next()};
  });
  const test::PluginLibrary library("turbulence_smagorinsky");
  const std::vector<sdk::Value> coefficient = {0.17};
  const std::unique_ptr<sdk::TurbulenceModel> eddies(
      static_cast<sdk::TurbulenceModel*>(library.offers.at(0).factory(coefficient).release()));
  c.air.solver->use(*eddies);
  constexpr double k_begin = 4.0;
  constexpr double k_end = 10.0;
  fluid::CellField mean(c.air.grid.size, 0.0);
  int count = 0;
  while (c.air.time < k_end - 1e-9) {
    c.advance(k_step);
    if (c.air.time < k_begin) continue;
    ++count;
    for (std::size_t n = 0; n < mean.size(); ++n) {
      mean[n] -= c.air.solver->velocity().component[2][n];
    }
  }
  const double buoyancy = DustyCase::k_gravity * k_flow / k_density;  // [m4/s3]
  std::vector<double> height, flow;
  for (int k = k_cells[2] - 12; k > 14; --k) {
    double fastest = 0.0;
    double sum = 0.0;
    for (int pass = 0; pass < 2; ++pass) {
      for (int j = 0; j < k_cells[1]; ++j) {
        for (int i = 0; i < k_cells[0]; ++i) {
          const double down = mean[static_cast<std::size_t>(c.air.grid.index(i, j, k))] / count;
          if (pass == 0) fastest = std::max(fastest, down);
          // The plume, not what streams to it from the sides.
          if (pass == 1 && down > 0.05 * fastest) sum += down * k_cell * k_cell;
        }
      }
    }
    height.push_back((k_cells[2] - k) * k_cell);
    flow.push_back(sum);
  }
  // From the virtual origin: where Q^(3/5), linear in z, is zero.
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  const auto n = static_cast<double>(height.size());
  for (std::size_t k = 0; k < height.size(); ++k) {
    const double y = std::pow(flow[k], 0.6);
    sx += height[k];
    sy += y;
    sxx += height[k] * height[k];
    sxy += height[k] * y;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  const double origin = sx / n - sy / n / slope;
  std::vector<double> from_origin;
  for (const double z : height) from_origin.push_back(z - origin);
  const PowerLaw law = fit(from_origin, flow);
  const double constant = std::pow(slope, 5.0 / 3.0) / std::cbrt(buoyancy);
  const PowerLaw plain = fit(height, flow);
  MESSAGE("exponent " << plain.exponent << " from the ceiling, " << law.exponent
                      << " from the virtual origin at " << 1e3 * origin << " mm; C " << constant);
  // Measured plumes: 0.14 to 0.16; entrainment 0.10 to 0.13 in Morton, Taylor and Turner (1956).
  CHECK(std::abs(law.exponent - 5.0 / 3.0) < 0.2);
  CHECK(constant > 0.11);
  CHECK(constant < 0.17);
  CHECK(std::abs(c.field->balance(0).error()) < 1e-12);
}

// SPDX-License-Identifier: Apache-2.0
#include "contract/plugin_library.hpp"
#include "dust/sdk/random.hpp"
#include "support/approx.hpp"
#include "voidage/divided/divided.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

namespace {

using namespace dust;

using Cell = std::tuple<int, int, int>;

/// Area [1] of the part of a disk of radius `rho` round 0 with u < `u` and v < `v`.
double disk_part(double rho, double u, double v) {
  // Strips in u, each of known height; substitution u = rho sin(t) makes the ends smooth.
  const double top = std::asin(std::clamp(u / rho, -1.0, 1.0));
  const double kink = std::asin(std::sqrt(std::max(0.0, 1.0 - std::min(1.0, v * v / (rho * rho)))));
  double area = 0.0;
  std::vector<double> marks{-std::numbers::pi / 2, -kink, kink, top};
  std::sort(marks.begin(), marks.end());
  for (std::size_t m = 0; m + 1 < marks.size(); ++m) {
    const double low = std::min(marks[m], top);
    const double high = std::min(marks[m + 1], top);
    // Five-point Gauss on 8 panels.
    const double nodes[] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                            0.9061798459386640};
    const double weights[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                              0.4786286704993665, 0.2369268850561891};
    constexpr int k_panels = 8;
    const double width = (high - low) / k_panels;
    for (int p = 0; p < k_panels; ++p) {
      for (int n = 0; n < 5; ++n) {
        const double t = low + (p + 0.5 + 0.5 * nodes[n]) * width;
        const double half = rho * std::cos(t);
        const double height = std::clamp(v, -half, half) + half;
        area += 0.5 * width * weights[n] * height * rho * std::cos(t);
      }
    }
  }
  return area;
}

/// Share of a unit sphere in { x < a, y < b, z < c } by quadrature over disks.
double sphere_part(double a, double b, double c) {
  constexpr int k_slices = 4000;
  double volume = 0.0;
  const double top = std::asin(std::clamp(a, -1.0, 1.0));
  const double low = -std::numbers::pi / 2;
  const double width = (top - low) / k_slices;
  for (int s = 0; s < k_slices; ++s) {
    const double t = low + (s + 0.5) * width;
    const double rho = std::cos(t);
    volume += disk_part(rho, b, c) * rho * width;
  }
  return volume / (4.0 / 3.0 * std::numbers::pi);
}

struct Rule {
  std::unique_ptr<sdk::VoidageRule> rule;
  sdk::GridShape grid;

  std::map<Cell, double> shares(sdk::Vec3 p, double radius) const {
    const int capacity = rule->capacity(grid, radius);
    int used = 0;
    std::vector<int> i(capacity), j(capacity), k(capacity);
    std::vector<double> weight(capacity);
    rule->spread(grid, {1, &p.x, &p.y, &p.z, &radius, capacity, &used, i.data(), j.data(), k.data(),
                        weight.data()});
    std::map<Cell, double> result;
    for (int n = 0; n < used; ++n) result[{i[n], j[n], k[n]}] += weight[n];
    CHECK(static_cast<int>(result.size()) == used);  // no cell twice
    return result;
  }
};

const sdk::GridShape k_grid{{-1.0, 0.5, 2.0}, {0.1, 0.13, 0.17}, {20, 20, 20}};

TEST_CASE("divided shares shall be the overlap volumes of sphere and cells") {
  // Midpoint slices: error of second order in 1/4000.
  constexpr double k_quadrature = 2e-6;
  const Rule divided{test::make_model<sdk::VoidageRule>("voidage", "divided"), k_grid};
  const sdk::Random random(3, sdk::stream_of("voidage"));
  const double radius = 0.025;  // D/dx = 0.5 in x
  for (std::uint32_t n = 0; n < 12; ++n) {
    // Close to a corner of cells, so that all eight are met.
    sdk::Vec3 p{-1.0 + 0.1 * 7, 0.5 + 0.13 * 4, 2.0 + 0.17 * 9};
    for (int d = 0; d < 3; ++d) p[d] += 0.9 * radius * (2.0 * random.uniform(n, 0, d) - 1.0);
    const auto shares = divided.shares(p, radius);
    const auto found = [&](int i, int j, int k) {
      const auto s = shares.find({i, j, k});
      return s == shares.end() ? 0.0 : s->second;
    };
    // Part of the sphere below the three planes through the corner, as sums of cells.
    const double a = (-1.0 + 0.1 * 7 - p.x) / radius;
    const double b = (0.5 + 0.13 * 4 - p.y) / radius;
    const double c = (2.0 + 0.17 * 9 - p.z) / radius;
    CHECK(std::abs(found(6, 3, 8) - sphere_part(a, b, c)) < k_quadrature);
    CHECK(std::abs(found(7, 3, 8) - sphere_part(-a, b, c)) < k_quadrature);
    CHECK(std::abs(found(6, 4, 8) - sphere_part(a, -b, c)) < k_quadrature);
    CHECK(std::abs(found(7, 4, 9) - sphere_part(-a, -b, -c)) < k_quadrature);
    CHECK(std::abs(found(6, 4, 9) - sphere_part(a, -b, -c)) < k_quadrature);
  }
}

TEST_CASE("a sphere centred on planes shall be halved, quartered and cut in eight") {
  using model::divided::cap;
  using model::divided::corner;
  using model::divided::edge;
  CHECK(cap(0.0) == test::approx(0.5).epsilon(1e-15));
  CHECK(edge(0.0, 0.0) == test::approx(0.25).epsilon(1e-14));
  CHECK(corner(0.0, 0.0, 0.0) == test::approx(0.125).epsilon(1e-14));
  // A plane through the centre halves what the others leave.
  CHECK(edge(0.3, 0.0) == test::approx(0.5 * cap(0.3)).epsilon(1e-13));
  CHECK(corner(0.3, 0.4, 0.0) == test::approx(0.5 * edge(0.3, 0.4)).epsilon(1e-12));
  // Nothing lies beyond an edge or a corner outside the sphere.
  CHECK(edge(0.6, 0.81) == 0.0);
  CHECK(corner(0.6, 0.6, 0.6) == 0.0);
  CHECK(edge(0.6, 0.79) > 0.0);
  CHECK(edge(0.6, 0.79) < 1e-3);
}

TEST_CASE("shares of a grain shall sum to 1 and none shall be negative") {
  constexpr double k_rounding = 4e-16;
  const sdk::Random random(5, sdk::stream_of("voidage"));
  for (const char* name : {"divided", "centre"}) {
    const Rule rule{test::make_model<sdk::VoidageRule>("voidage", name), k_grid};
    CHECK(rule.rule->largest_diameter_over_spacing() == 0.5);
    std::size_t most = 0;
    for (std::uint32_t n = 0; n < 20000; ++n) {
      sdk::Vec3 p;
      for (int d = 0; d < 3; ++d) {
        p[d] = k_grid.origin[d] + k_grid.spacing[d] * 20.0 * random.uniform(n, 1, d);
      }
      const double radius = 0.025 * random.uniform(n, 1, 3);
      const auto shares = rule.shares(p, radius);
      double sum = 0.0;
      double smallest = 1.0;
      for (const auto& [cell, weight] : shares) {
        sum += weight;
        smallest = std::min(smallest, weight);
      }
      most = std::max(most, shares.size());
      REQUIRE(std::abs(sum - 1.0) <= k_rounding);
      REQUIRE(smallest >= 0.0);
    }
    CHECK(most == (std::string(name) == "divided" ? 8 : 1));
  }
}

TEST_CASE("parts of a sphere beyond planes on either side of its centre shall be exact") {
  using sdk::sphere_parts::any_corner;
  constexpr double k_quadrature = 2e-6;
  const sdk::Random random(11, sdk::stream_of("planes"));
  for (std::uint32_t n = 0; n < 20; ++n) {
    double p[3];
    for (std::uint32_t d = 0; d < 3; ++d) p[d] = 2.2 * random.uniform(n, 0, d) - 1.1;
    // sphere_part is the part before the planes: mirrored.
    CHECK(std::abs(any_corner(p[0], p[1], p[2]) - sphere_part(-p[0], -p[1], -p[2])) < k_quadrature);
  }
}

TEST_CASE("a big particle shall fill the cells inside it to the inner void fraction") {
  const sdk::GridShape grid{{0, 0, 0}, {1e-3, 1e-3, 1e-3}, {20, 20, 20}};
  const Rule big{test::make_model<sdk::VoidageRule>("voidage", "big_particle"), grid};
  constexpr double k_inner = 0.5;  // the default
  const double radius = 2e-3;      // D/dx = 4
  const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  const double reach = radius / std::cbrt(1.0 - k_inner);
  const sdk::Vec3 p{10.2e-3, 9.9e-3, 10.4e-3};
  int inside = 0;
  for (const auto& [cell, weight] : big.shares(p, radius)) {
    const auto [i, j, k] = cell;
    double farthest = 0.0;
    double nearest = 0.0;
    const int index[3] = {i, j, k};
    for (int d = 0; d < 3; ++d) {
      const double low = index[d] * 1e-3 - p[d];
      farthest += std::pow(std::max(std::abs(low), std::abs(low + 1e-3)), 2);
      nearest += std::pow(std::max({0.0, low, -low - 1e-3}), 2);
    }
    CHECK(std::sqrt(nearest) < reach);
    const double eps = 1.0 - weight * volume / 1e-9;
    CHECK(eps >= k_inner - 1e-12);
    if (std::sqrt(farthest) > reach) continue;
    CHECK(eps == test::approx(k_inner).epsilon(1e-11));
    ++inside;
  }
  CHECK(inside > 20);
}

TEST_CASE("a Gaussian grain shall have its centre and width, and move without a jump") {
  const sdk::GridShape grid{{0, 0, 0}, {1e-3, 1e-3, 1e-3}, {40, 40, 40}};
  const Rule gaussian{test::make_model<sdk::VoidageRule>("voidage", "gaussian"), grid};
  const double diameter = 1e-3;
  const double sigma = 1.5 * diameter;
  double first = 0.0;
  double second = 0.0;
  const sdk::Vec3 p{20.3e-3, 20.0e-3, 19.8e-3};
  for (const auto& [cell, weight] : gaussian.shares(p, 0.5 * diameter)) {
    const double x = (std::get<0>(cell) + 0.5) * 1e-3 - p.x;
    first += weight * x;
    second += weight * x * x;
  }
  // Cells see the kernel through a box of their width, h^2 / 12, and without its ends beyond three
  // deviations, which take 2.7 % of the second moment.
  CHECK(std::abs(first) < 0.01e-3);
  const double cut = 1.0 - 2.0 * 3.0 * std::exp(-4.5) /
                               (std::sqrt(2.0 * std::numbers::pi) * std::erf(3.0 / std::sqrt(2.0)));
  CHECK(second == test::approx(cut * sigma * sigma + 1e-6 / 12.0).epsilon(0.01));
  // Across a border of cells no share changes by more than the way times its steepest slope.
  const double step = 1e-7;
  const auto before = gaussian.shares({20e-3 - step, 20.5e-3, 20.5e-3}, 0.5 * diameter);
  const auto after = gaussian.shares({20e-3 + step, 20.5e-3, 20.5e-3}, 0.5 * diameter);
  for (const auto& [cell, weight] : after) {
    const auto old = before.find(cell);
    CHECK(std::abs(weight - (old == before.end() ? 0.0 : old->second)) < 2.0 * step / sigma);
  }
}

TEST_CASE("a kernel as wide as whole cells shall not take one more than it declares") {
  // Of a fine grain three deviations to either side are three cells, but for rounding, and both
  // ends fall on borders of cells where it lies in the middle of one.
  struct Domain {
    double min, max;
    int cells;
  };
  const double radius = 0.25e-3;
  for (const auto [origin, end, cells] :
       {Domain{-0.3, -0.16, 50}, {-0.3, -0.2, 29}, {0, 0.14, 50}, {1.7, 1.8, 30}}) {
    const double spacing = (end - origin) / cells;
    const sdk::GridShape grid{
        {origin, origin, origin}, {spacing, spacing, spacing}, {cells, cells, cells}};
    const Rule gaussian{test::make_model<sdk::VoidageRule>("voidage", "gaussian"), grid};
    const int capacity = gaussian.rule->capacity(grid, radius);
    // Room for what is beyond.
    std::vector<int> i(1000), j(1000), k(1000);
    std::vector<double> weight(1000);
    int most = 0;
    double smallest = 1.0;
    for (int n = 2; n < cells - 2; ++n) {
      // Micrometres are what a scenario would say.
      const double exact = origin + (n + 0.5) * spacing;
      for (const double at : {exact, std::round(exact * 1e6) / 1e6}) {
        const sdk::Vec3 p{at, at, at};
        int used = 0;
        gaussian.rule->spread(grid, {1, &p.x, &p.y, &p.z, &radius, capacity, &used, i.data(),
                                     j.data(), k.data(), weight.data()});
        most = std::max(most, used);
        for (int m = 0; m < used; ++m) smallest = std::min(smallest, weight[m]);
      }
    }
    CAPTURE(origin);
    CHECK(most <= capacity);
    CHECK(smallest > 1e-14);
  }
}

TEST_CASE("a grain inside one cell shall lie in that cell alone") {
  const Rule rule{test::make_model<sdk::VoidageRule>("voidage", "divided"), k_grid};
  const auto shares = rule.shares({-1.0 + 0.1 * 3.5, 0.5 + 0.13 * 2.5, 2.0 + 0.17 * 0.5}, 1e-3);
  REQUIRE(shares.size() == 1);
  CHECK(shares.begin()->first == Cell{3, 2, 0});
  CHECK(shares.begin()->second == 1.0);
}

}  // namespace

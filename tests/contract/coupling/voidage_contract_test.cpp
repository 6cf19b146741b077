// SPDX-License-Identifier: Apache-2.0
#include "contract/coupling/models.hpp"
#include "dust/sdk/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace dust;

const sdk::GridShape k_grid{{-0.5, 0.1, 0.0}, {0.01, 0.012, 0.015}, {20, 10, 10}};

/// Grains over the whole grid and a little beyond, up to the size the rule allows.
struct Columns {
  std::vector<double> x, y, z, radius;
};
Columns sample(const sdk::VoidageRule& rule) {
  Columns c;
  const sdk::Random random(7, sdk::stream_of("contract"));
  // Wide rules give a grain thousands of cells: fewer grains of theirs.
  const std::uint32_t count = rule.largest_diameter_over_spacing() > 1.0 ? 20 : 3000;
  for (std::uint32_t g = 0; g < count; ++g) {
    const auto place = [&](int d) {
      return k_grid.origin[d] +
             k_grid.spacing[d] * (k_grid.count[d] + 1.0) * (random.uniform(g, 0, d) - 0.02);
    };
    c.x.push_back(place(0));
    c.y.push_back(place(1));
    c.z.push_back(place(2));
    c.radius.push_back(0.5 * 0.01 * rule.largest_diameter_over_spacing() *
                       (g % 5 == 0 ? 1.0 : random.uniform(g, 0, 3)));
  }
  return c;
}

double largest_radius(const Columns& c) {
  return *std::max_element(c.radius.begin(), c.radius.end());
}

struct Shares {
  std::vector<int> used, i, j, k;
  std::vector<double> weight;
  bool operator==(const Shares&) const = default;
};
Shares spread(const sdk::VoidageRule& rule, const Columns& c, std::size_t batch) {
  const int capacity = rule.capacity(k_grid, largest_radius(c));
  const std::size_t count = c.x.size();
  const std::size_t rows = count * static_cast<std::size_t>(capacity);
  Shares s{std::vector<int>(count), std::vector<int>(rows), std::vector<int>(rows),
           std::vector<int>(rows), std::vector<double>(rows)};
  for (std::size_t first = 0; first < count; first += batch) {
    const std::size_t row = first * static_cast<std::size_t>(capacity);
    rule.spread(k_grid, {std::min(batch, count - first),
                         {c.x.data() + first, c.y.data() + first, c.z.data() + first},
                         c.radius.data() + first,
                         capacity,
                         s.used.data() + first,
                         s.i.data() + row,
                         s.j.data() + row,
                         s.k.data() + row,
                         s.weight.data() + row});
  }
  return s;
}

TEST_CASE("every voidage rule shall be described, with an example that names it") {
  const auto rules = test::all_models<sdk::VoidageRule>();
  CHECK(rules.size() >= 4);
  for (const auto& rule : rules) {
    CAPTURE(rule.info.name);
    CHECK_FALSE(rule.info.summary.empty());
    CHECK_FALSE(rule.info.equation.empty());
    CHECK_FALSE(rule.info.source.empty());
    CHECK(rule.model->largest_diameter_over_spacing() > 0.0);
    const std::string readme = test::readme_of(rule.info);
    CHECK(readme.find("voidage: {model: " + rule.info.name) != std::string::npos);
    CHECK(readme.find("Limits:") != std::string::npos);
  }
}

TEST_CASE("the shares of a grain shall sum to 1 and lie in the cells it touches") {
  constexpr double k_rounding = 4e-16;  // of each addition
  for (const auto& rule : test::all_models<sdk::VoidageRule>()) {
    CAPTURE(rule.info.name);
    const Columns c = sample(*rule.model);
    const int capacity = rule.model->capacity(k_grid, largest_radius(c));
    const Shares s = spread(*rule.model, c, c.x.size());
    for (std::size_t g = 0; g < c.x.size(); ++g) {
      REQUIRE(s.used[g] >= 1);
      REQUIRE(s.used[g] <= capacity);
      double sum = 0.0;
      double least = 1.0;
      bool is_near = true;
      for (int n = 0; n < s.used[g]; ++n) {
        const std::size_t row =
            g * static_cast<std::size_t>(capacity) + static_cast<std::size_t>(n);
        sum += s.weight[row];
        least = std::min(least, s.weight[row]);
        const sdk::Vec3 reach = rule.model->reach(k_grid, c.radius[g]);
        const auto is_touching = [&](double at, int d, int cell) {
          const double low = k_grid.origin[d] + cell * k_grid.spacing[d];
          const double rounding = 1e-12;
          return at + reach[d] >= low - rounding &&
                 at - reach[d] <= low + k_grid.spacing[d] + rounding;
        };
        is_near &= is_touching(c.x[g], 0, s.i[row]) && is_touching(c.y[g], 1, s.j[row]) &&
                   is_touching(c.z[g], 2, s.k[row]);
      }
      REQUIRE(least >= 0.0);
      REQUIRE(is_near);
      REQUIRE(std::abs(sum - 1.0) <= k_rounding * std::sqrt(s.used[g]));
    }
  }
}

TEST_CASE("a voidage rule shall give the same bits however its batch is split") {
  for (const auto& rule : test::all_models<sdk::VoidageRule>()) {
    CAPTURE(rule.info.name);
    const Columns c = sample(*rule.model);
    const Shares whole = spread(*rule.model, c, c.x.size());
    for (const std::size_t batch : {1, 3, 64}) CHECK(spread(*rule.model, c, batch) == whole);
  }
}

}  // namespace

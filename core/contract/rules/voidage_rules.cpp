// SPDX-License-Identifier: Apache-2.0
// Rules of voidage rules: what spreads a volume keeps it.
#include "contract/as_kind.hpp"
#include "contract/rule_runner.hpp"
#include "dust/sdk/random.hpp"
#include "dust/sdk/voidage_rule.hpp"

#include <algorithm>
#include <cmath>

namespace dust::contract {
namespace {

sdk::GridShape grid_in(const Units& u) {
  return {
      u.length * sdk::Vec3{-0.5, 0.1, 0.0}, u.length * sdk::Vec3{0.01, 0.012, 0.015}, {20, 10, 10}};
}

/// Grains over the whole grid and a little beyond, up to `largest` [m] in diameter.
struct Columns {
  std::vector<double> x, y, z, radius;
};
Columns sample(const sdk::GridShape& grid, double largest, std::uint32_t count) {
  Columns c;
  const sdk::Random random(7, sdk::stream_of("contract"));
  for (std::uint32_t g = 0; g < count; ++g) {
    const auto place = [&](int d) {
      return grid.origin[d] + grid.spacing[d] * (grid.count[d] + 1.0) *
                                  (random.uniform(g, 0, static_cast<std::uint32_t>(d)) - 0.02);
    };
    c.x.push_back(place(0));
    c.y.push_back(place(1));
    c.z.push_back(place(2));
    c.radius.push_back(0.5 * largest * (g % 5 == 0 ? 1.0 : random.uniform(g, 0, 3)));
  }
  return c;
}

/// Up to the size that the rule allows, and no larger than its shares fit into the grid.
double largest_diameter(const sdk::VoidageRule& rule, const sdk::GridShape& grid) {
  const int cells = grid.count[0] * grid.count[1] * grid.count[2];
  double largest = grid.spacing.x * rule.largest_diameter_over_spacing();
  constexpr int k_halvings = 4;
  for (int n = 0; n < k_halvings && rule.capacity(grid, 0.5 * largest) > cells; ++n) largest *= 0.5;
  return largest;
}

struct Shares {
  Columns grains;
  int capacity = 0;
  std::vector<int> used, i, j, k;
  std::vector<double> weight;
};
Shares spread(const Maker& make, const TestVariant& variant) {
  const auto rule = make_as<sdk::VoidageRule>(make, variant.units);
  const double widest = rule->largest_diameter_over_spacing();
  require(widest > 0.0, "it is valid for no grain at all: largest_diameter_over_spacing() is " +
                            shown(widest) + "; expected: above 0");
  const sdk::GridShape grid = grid_in(variant.units);
  Shares s;
  const double largest = largest_diameter(*rule, grid);
  s.capacity = rule->capacity(grid, 0.5 * largest);
  require(s.capacity >= 1, "its capacity is " + std::to_string(s.capacity));
  // Shares are of different cells; a width far beyond the grid would ask for all memory.
  const int cells = grid.count[0] * grid.count[1] * grid.count[2];
  require(s.capacity <= cells, "its capacity is " + std::to_string(s.capacity) +
                                   " shares per grain, more than the " + std::to_string(cells) +
                                   " cells of the grid");
  // Fewer grains where each has many shares.
  constexpr int k_shares = 24000;
  s.grains = sample(grid, largest,
                    static_cast<std::uint32_t>(std::clamp(k_shares / s.capacity, 60, 3000)));
  const std::size_t count = s.grains.x.size();
  const std::size_t rows = count * static_cast<std::size_t>(s.capacity);
  // A row more than there are, to see who writes there.
  s.used.assign(count + 1, -1);
  s.i.assign(rows + 1, 0);
  s.j = s.k = s.i;
  s.weight.assign(rows + 1, 0.0);
  const std::size_t size = variant.batch == 0 ? count : variant.batch;
  for (std::size_t first = 0; first < count; first += size) {
    const std::size_t row = first * static_cast<std::size_t>(s.capacity);
    const sdk::VoidageBatch batch{std::min(size, count - first),
                                  s.grains.x.data() + first,
                                  s.grains.y.data() + first,
                                  s.grains.z.data() + first,
                                  s.grains.radius.data() + first,
                                  s.capacity,
                                  s.used.data() + first,
                                  s.i.data() + row,
                                  s.j.data() + row,
                                  s.k.data() + row,
                                  s.weight.data() + row};
    call_hot(variant, [&] { rule->spread(grid, batch); });
  }
  require(s.used.back() == -1 && s.weight.back() == 0.0, "it writes beyond the end of the batch");
  for (std::size_t g = 0; g < count; ++g) {
    require(s.used[g] >= 1 && s.used[g] <= s.capacity, "grain " + std::to_string(g) + " uses " +
                                                           std::to_string(s.used[g]) + " of " +
                                                           std::to_string(s.capacity) + " rows");
  }
  return s;
}

Observations observe(const Maker& make, const TestVariant& variant) {
  const Shares s = spread(make, variant);
  Observations observations;
  for (std::size_t g = 0; g < s.grains.x.size(); ++g) {
    const std::string grain = " of grain " + std::to_string(g);
    observations.push_back({"used" + grain, static_cast<double>(s.used[g]), {}, false});
    for (int n = 0; n < s.used[g]; ++n) {
      const std::size_t row =
          g * static_cast<std::size_t>(s.capacity) + static_cast<std::size_t>(n);
      observations.push_back({"weight" + grain, s.weight[row], sdk::dimension::none});
      observations.push_back(
          {"cell_i" + grain, static_cast<double>(s.i[row]), sdk::dimension::none});
      observations.push_back(
          {"cell_j" + grain, static_cast<double>(s.j[row]), sdk::dimension::none});
      observations.push_back(
          {"cell_k" + grain, static_cast<double>(s.k[row]), sdk::dimension::none});
    }
  }
  return observations;
}

void check_shares(const Maker& make) {
  // Shares of eight cells, each rounded to half an ulp of 1.
  constexpr double k_rounding = 1e-15;
  const Shares s = spread(make, {});
  const auto rule = make_as<sdk::VoidageRule>(make);
  const sdk::GridShape grid = grid_in({});
  for (std::size_t g = 0; g < s.grains.x.size(); ++g) {
    const sdk::Vec3 at{s.grains.x[g], s.grains.y[g], s.grains.z[g]};
    const sdk::Vec3 reach = rule->reach(grid, s.grains.radius[g]);
    const auto is_within = [&](int d, int cell) {
      const double low = grid.origin[d] + cell * grid.spacing[d];
      const double rounding = 1e-12;
      return at[d] + reach[d] >= low - rounding &&
             at[d] - reach[d] <= low + grid.spacing[d] + rounding;
    };
    double sum = 0.0;
    for (int n = 0; n < s.used[g]; ++n) {
      const std::size_t row =
          g * static_cast<std::size_t>(s.capacity) + static_cast<std::size_t>(n);
      sum += s.weight[row];
      require(s.weight[row] >= 0.0,
              "a share is negative: " + shown(s.weight[row]) + "; expected: from 0 on");
      require(is_within(0, s.i[row]) && is_within(1, s.j[row]) && is_within(2, s.k[row]),
              "grain " + std::to_string(g) + " has a share in a cell beyond reach()");
    }
    require(std::abs(sum - 1.0) <= k_rounding * std::max(1.0, s.used[g] / 8.0),
            "the shares of a grain sum to 1 " + std::string(sum > 1.0 ? "+ " : "- ") +
                shown(std::abs(sum - 1.0)));
  }
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  runner.rule("conserves volume: the shares of a grain sum to 1, in cells within its reach",
              [&] { check_shares(make); });
}

}  // namespace

Kind voidage_kind() {
  return {.observe = observe,
          .batches = {1, 3, 64},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = true,
          .rules = rules};
}

}  // namespace dust::contract

// SPDX-License-Identifier: Apache-2.0
// Rules of drag laws.
#include "contract/as_kind.hpp"
#include "contract/rule_runner.hpp"
#include "dust/sdk/drag_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::contract {
namespace {

const double k_void_fractions[] = {0.3, 0.36, 0.5, 0.8, 0.81, 0.95, 1.0};
const double k_reynolds[] = {0.0, 1e-6, 1e-2, 1.0, 33.0, 999.0, 1001.0, 1e5};
constexpr std::size_t k_per_void_fraction = std::size(k_reynolds);
/// What a printed law may step down where two fits meet, in parts of the force: Abraham's does by
/// 9 % at Re 1000, from 0.484 to 0.44.
constexpr double k_step_of_fits = 0.1;

struct Columns {
  std::vector<double> reynolds, void_fraction, factor;
  Columns() {
    for (const double eps : k_void_fractions) {
      for (const double re : k_reynolds) {
        reynolds.push_back(re);
        void_fraction.push_back(eps);
      }
    }
  }
};

Columns evaluate(const Maker& make, const TestVariant& variant) {
  const auto law = make_as<sdk::DragLaw>(make, variant.units);
  Columns c;
  constexpr double k_guard = -7.25e77;
  const std::size_t rows = c.reynolds.size();
  const std::vector<double> reynolds = c.reynolds;
  const std::vector<double> void_fraction = c.void_fraction;
  c.factor.assign(rows, std::numeric_limits<double>::quiet_NaN());
  c.factor.push_back(k_guard);
  const std::size_t size = variant.batch == 0 ? rows : variant.batch;
  const std::vector<double> mean_size(size, 1.0);
  for (std::size_t first = 0; first < rows; first += size) {
    sdk::DragBatch batch{std::min(size, rows - first), c.reynolds.data() + first,
                         c.void_fraction.data() + first, c.factor.data() + first};
    // A law for several sizes sees a grain of the mean size.
    if (law->needs_size_ratio()) batch.size_ratio = mean_size.data();
    call_hot(variant, [&] { law->evaluate(batch); });
  }
  require(c.factor.back() == k_guard, "it writes beyond the end of the batch");
  require(c.reynolds == reynolds && c.void_fraction == void_fraction, "it overwrites its input");
  c.factor.pop_back();
  return c;
}

Observations observe(const Maker& make, const TestVariant& variant) {
  const Columns c = evaluate(make, variant);
  Observations observations;
  for (std::size_t n = 0; n < c.factor.size(); ++n) {
    observations.push_back(
        {"factor at Re " + shown(c.reynolds[n]) + ", void fraction " + shown(c.void_fraction[n]),
         c.factor[n], sdk::dimension::none});
  }
  return observations;
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  runner.rule("is never negative, and its force grows with the slip", [&] {
    const Columns c = evaluate(make, {});
    std::string falls;
    for (std::size_t n = 0; n < c.factor.size(); ++n) {
      require(c.factor[n] >= 0.0, "F = " + shown(c.factor[n]) + " at Re " + shown(c.reynolds[n]) +
                                      ", void fraction " + shown(c.void_fraction[n]) +
                                      "; expected: from 0 on");
      if (n % k_per_void_fraction == 0) continue;
      const std::string where = " between Re " + shown(c.reynolds[n - 1]) + " and " +
                                shown(c.reynolds[n]) + " at void fraction " +
                                shown(c.void_fraction[n]);
      const double growth = c.reynolds[n] / c.reynolds[n - 1];
      // A force that falls drives grains apart. Printed laws have steps where two fits meet.
      require(!(c.factor[n] * growth < (1.0 - k_step_of_fits) * c.factor[n - 1]),
              "the force falls" + where + ": F from " + shown(c.factor[n - 1]) + " to " +
                  shown(c.factor[n]) + ", F Re has to grow");
      if (c.factor[n] < c.factor[n - 1] && falls.empty()) falls = where;
    }
    if (!falls.empty()) throw Remark("F, the force over Stokes's, falls" + falls);
  });
  // The growth with the slip is taken relative to it. Laws of beds may end at 0 where no grain is.
  runner.rule("is above 0 among grains without slip", [&] {
    const Columns c = evaluate(make, {});
    for (std::size_t n = 0; n < c.factor.size(); n += k_per_void_fraction) {
      if (c.void_fraction[n] == 1.0) continue;
      require(c.factor[n] > 0.0 && std::isfinite(c.factor[n]),
              "F = " + shown(c.factor[n]) + " at Re 0, void fraction " + shown(c.void_fraction[n]) +
                  ": a slow grain has a drag; give the law its creeping limit");
    }
  });
  runner.rule("is Stokes's law for a lone slow grain: F(0, 1) = 1", [&] {
    const Columns c = evaluate(make, {});
    const double isolated = c.factor[c.factor.size() - k_per_void_fraction + 1];
    // At Re = 1e-6 the usual inertial corrections are below 1e-4.
    if (std::abs(isolated - 1.0) > 1e-3) {
      throw Remark("F = " + shown(isolated) + ": meant for crowds only? Its limits should say so");
    }
  });
}

}  // namespace

Kind drag_kind() {
  return {.observe = observe,
          .batches = {1, 3, 8},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = true,
          .rules = rules};
}

}  // namespace dust::contract

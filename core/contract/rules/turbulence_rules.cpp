// SPDX-License-Identifier: Apache-2.0
// Rules of turbulence models: an eddy viscosity that is never negative and vanishes where nothing
// is sheared.
#include "contract/as_kind.hpp"
#include "contract/rule_runner.hpp"
#include "dust/sdk/turbulence_model.hpp"

#include <algorithm>

namespace dust::contract {
namespace {

namespace dim = sdk::dimension;

const double k_rates[] = {0.0, 1e-3, 1.0, 40.0, 3000.0};     // 1/s
const double k_distances[] = {1e-5, 1e-3, 5e-3, 0.1, 10.0};  // m
constexpr std::size_t k_count = std::size(k_rates) * std::size(k_distances);

std::vector<double> evaluate(const Maker& make, const TestVariant& variant, double width = 5e-3) {
  const auto model = make_as<sdk::TurbulenceModel>(make, variant.units);
  const Units& u = variant.units;
  std::vector<double> rate;
  std::vector<double> distance;
  for (const double s : k_rates) {
    for (const double d : k_distances) {
      rate.push_back(s / u.time);
      distance.push_back(d * u.length);
    }
  }
  const std::vector<double> density(k_count, 1.2 * u.of(dim::density));
  const std::vector<double> viscosity(k_count, 1.8e-5 * u.of(dim::dynamic_viscosity));
  constexpr double k_guard = -7.25e77;
  std::vector<double> eddy(k_count + 1, k_guard);
  const std::size_t most = variant.batch == 0 ? k_count : variant.batch;
  for (std::size_t first = 0; first < k_count; first += most) {
    const sdk::TurbulenceBatch batch{std::min(most, k_count - first),
                                     width * u.length,
                                     rate.data() + first,
                                     distance.data() + first,
                                     density.data() + first,
                                     viscosity.data() + first,
                                     eddy.data() + first};
    call_hot(variant, [&] { model->evaluate(batch); });
  }
  require(eddy.back() == k_guard, "it writes beyond the end of the batch");
  eddy.pop_back();
  return eddy;
}

Observations observe(const Maker& make, const TestVariant& variant) {
  Observations observations;
  for (const double value : evaluate(make, variant)) {
    observations.push_back({"eddy_viscosity", value, dim::dynamic_viscosity});
  }
  return observations;
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  runner.rule("gives no negative eddy viscosity, and none where nothing is sheared", [&] {
    const auto eddy = evaluate(make, {});
    for (std::size_t n = 0; n < k_count; ++n) {
      require(eddy[n] >= 0.0, shown(eddy[n]) + " Pa s; expected: from 0 on");
      require(n >= std::size(k_distances) || eddy[n] == 0.0,
              shown(eddy[n]) + " Pa s without any shear; expected: 0");
    }
  });
  runner.rule("vanishes as the cells become small", [&] {
    const auto coarse = evaluate(make, {});
    const auto fine = evaluate(make, {}, 5e-7);
    for (std::size_t n = std::size(k_distances); n < k_count; ++n) {
      if (fine[n] <= 0.01 * coarse[n]) continue;
      throw Remark("cells 10,000 times smaller still have " + shown(fine[n]) +
                   " Pa s: a model of all eddies, not of those smaller than a cell? Its limits "
                   "should say so");
    }
  });
}

}  // namespace

Kind turbulence_kind() {
  return {.observe = observe,
          .batches = {1, 3, 8},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = true,
          .rules = rules};
}

}  // namespace dust::contract

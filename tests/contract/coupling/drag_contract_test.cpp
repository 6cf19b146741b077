// SPDX-License-Identifier: Apache-2.0
#include "contract/coupling/models.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace {

using namespace dust;

struct Columns {
  std::vector<double> reynolds, void_fraction, size_ratio;
};
Columns sample() {
  Columns c;
  for (const double eps : {0.3, 0.36, 0.5, 0.8, 0.81, 0.95, 1.0}) {
    for (const double reynolds : {0.0, 1e-6, 1e-2, 1.0, 33.0, 999.0, 1001.0, 1e5}) {
      c.reynolds.push_back(reynolds);
      c.void_fraction.push_back(eps);
      c.size_ratio.push_back(1.0);
    }
  }
  return c;
}
std::vector<double> factors(const sdk::DragLaw& law, const Columns& c, std::size_t batch) {
  std::vector<double> result(c.reynolds.size(), -1.0);
  for (std::size_t first = 0; first < result.size(); first += batch) {
    const std::size_t count = std::min(batch, result.size() - first);
    law.evaluate({count, c.reynolds.data() + first, c.void_fraction.data() + first,
                  result.data() + first,
                  law.needs_size_ratio() ? c.size_ratio.data() + first : nullptr});
  }
  return result;
}

TEST_CASE("every drag law shall be described, with an example that names it") {
  const auto laws = test::all_models<sdk::DragLaw>();
  CHECK(laws.size() >= 9);
  for (const auto& law : laws) {
    CAPTURE(law.info.name);
    CHECK_FALSE(law.info.summary.empty());
    CHECK_FALSE(law.info.equation.empty());
    CHECK_FALSE(law.info.source.empty());
    const std::string readme = test::readme_of(law.info);
    CHECK(readme.find("drag: {model: " + law.info.name) != std::string::npos);
    CHECK(readme.find("Source:") != std::string::npos);
    CHECK(readme.find("Limits:") != std::string::npos);
  }
}

TEST_CASE("a drag law shall give the same bits however its batch is split") {
  const Columns c = sample();
  for (const auto& law : test::all_models<sdk::DragLaw>()) {
    CAPTURE(law.info.name);
    const std::vector<double> whole = factors(*law.model, c, c.reynolds.size());
    for (const std::size_t batch : {1, 3, 8}) CHECK(factors(*law.model, c, batch) == whole);
  }
}

TEST_CASE(
    "a drag law shall give finite factors, above 0 among grains, and a force that grows with the "
    "slip") {
  const Columns c = sample();
  for (const auto& law : test::all_models<sdk::DragLaw>()) {
    CAPTURE(law.info.name);
    const std::vector<double> f = factors(*law.model, c, c.reynolds.size());
    for (std::size_t n = 0; n < f.size(); ++n) {
      CHECK(std::isfinite(f[n]));
      // Without slip, too: its growth is taken relative to it. Ergun's ends at 0 without grains.
      CHECK(f[n] >= 0.0);
      if (c.void_fraction[n] < 1.0) CHECK(f[n] > 0.0);
      const bool is_same_eps = n > 0 && c.void_fraction[n] == c.void_fraction[n - 1];
      // The factor itself may dip (Di Felice's exponent does); the force, F Re, may only where a
      // law of one sphere goes over to a constant coefficient at Re 1000: Abraham's by 9 %.
      const bool is_step = is_same_eps && c.reynolds[n - 1] == 999.0;
      if (!is_same_eps) continue;
      CHECK(f[n] * c.reynolds[n] >= (is_step ? 0.9 : 1.0) * f[n - 1] * c.reynolds[n - 1]);
    }
  }
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
#include "contract/rules/symmetry_rules.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dust::contract {
namespace {

using sdk::Vec3;

void check_close(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::string& why) {
  constexpr double k_rounding = 1e-9;
  for (std::size_t n = 0; n < a.size(); ++n) {
    const double size = std::max({norm(a[n]), norm(b[n]), 1e-300});
    require(norm(a[n] - b[n]) <= k_rounding * size, why + " differs by " +
                                                        shown(norm(a[n] - b[n]) / size) +
                                                        " of it on contact " + std::to_string(n));
  }
}

}  // namespace

void check_symmetry(RuleRunner& runner, const std::string& what, const ShowContacts& show) {
  const auto same = [](std::vector<Touch> t) { return t; };
  runner.rule("treats both sides alike: action = reaction", [&] {
    std::vector<Vec3> other = show(true, [](auto t) { return swapped(std::move(t)); });
    for (Vec3& v : other) v = -v;
    check_close(show(false, same), other, "seen from the other side the " + what);
    // Which of two grains is side i has nothing to do with the order that prepare() was told.
    other = show(false, [](auto t) { return swapped(std::move(t)); });
    for (Vec3& v : other) v = -v;
    check_close(show(false, same), other,
                "with the sides changed and prepare() told the materials as before the " + what);
  });
  runner.rule("knows no preferred direction", [&] {
    std::vector<Vec3> here = show(false, same);
    for (Vec3& v : here) v = turned(v);
    check_close(here, show(false, [](auto t) { return turned(std::move(t)); }),
                "in a turned world the " + what);
  });
}

}  // namespace dust::contract

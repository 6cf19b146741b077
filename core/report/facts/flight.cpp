// SPDX-License-Identifier: Apache-2.0
#include "report/facts/flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::report {

namespace {

using State = std::array<double, 4>;  // forward, drop [m]; their rates [m/s]

State moved(const State& s, const State& rate, double step) {
  State next = s;
  for (std::size_t k = 0; k < s.size(); ++k) next[k] += step * rate[k];
  return next;
}

}  // namespace

std::vector<double> isolated_flight(const IsolatedGrain& grain, const StillAir& air, double gravity,
                                    std::span<const double> drops) {
  std::vector<double> places;
  if (drops.empty() || !(grain.density > air.density) || !(gravity > 0.0)) return places;
  const double stokes = 18.0 * air.viscosity / (grain.density * grain.diameter * grain.diameter);
  const double weight = gravity * (1.0 - air.density / grain.density);
  const auto rate = [&](const State& s) {
    const double speed = std::hypot(s[2], s[3]);
    const double reynolds =
        air.viscosity > 0.0 ? air.density * speed * grain.diameter / air.viscosity : 0.0;
    const double drag = stokes * (1.0 + 0.15 * std::pow(reynolds, 0.687));
    return State{s[2], s[3], -drag * s[2], weight - drag * s[3]};
  };
  constexpr double k_longest_step = 1e-3;  // [s]
  const double step = stokes > 0.0 ? std::min(k_longest_step, 0.02 / stokes) : k_longest_step;
  State s{0.0, 0.0, grain.speed, 0.0};
  for (const double drop : drops) {
    State before = s;
    while (s[1] < drop) {
      before = s;
      const State a = rate(s), b = rate(moved(s, a, 0.5 * step));
      const State c = rate(moved(s, b, 0.5 * step)), d = rate(moved(s, c, step));
      for (std::size_t k = 0; k < s.size(); ++k) {
        s[k] += step / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
      }
    }
    const double way = s[1] - before[1];
    const double share = way > 0.0 ? (drop - before[1]) / way : 0.0;
    places.push_back(before[0] + share * (s[0] - before[0]));
    // Later drops go on from the step that passed this one.
    s = before;
  }
  return places;
}

}  // namespace dust::report

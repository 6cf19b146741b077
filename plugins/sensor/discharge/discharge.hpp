// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace dust::model::discharge {

/// Mass flow [kg/s] through a round hole by the correlation of Beverloo, Leniger and van de Velde,
/// Chem. Eng. Sci. 15 (1961) 260, doi:10.1016/0009-2509(61)85030-6:
/// \f$ W = C \rho_b \sqrt g (D_0 - k d)^{5/2} \f$; 0 where D_0 <= k d.
/// @param bulk_density [kg/m3]  @param gravity [m/s2]  @param hole D_0 [m]  @param diameter d [m]
inline double beverloo(double c, double k, double bulk_density, double gravity, double hole,
                       double diameter) {
  const double open = hole - k * diameter;
  return open > 0.0 ? c * bulk_density * std::sqrt(gravity) * std::pow(open, 2.5) : 0.0;
}

/// A rate with one standard error, negative where there is none.
struct Rate {
  double value = 0.0;
  double error = -1.0;
};

/// Mean rate while the amount passed grows from the share `low` to the share `high` of all, so that
/// the beginning and the trickle at the end do not count; from nothing on where `low` is 0, without
/// the time before anything passes. The error comes from the rates of ten
/// equal parts of that time.
/// @param time    [s] end of each sample, ascending
/// @param passed  amount passed until then, not descending
inline Rate middle_rate(std::span<const double> time, std::span<const double> passed, double low,
                        double high) {
  constexpr std::size_t k_parts = 10;
  if (passed.size() < 2 || !(passed.back() > 0.0)) return {};
  const auto reach = [&](double share) {
    const auto at = std::lower_bound(passed.begin(), passed.end(), share * passed.back());
    return static_cast<std::size_t>(at - passed.begin());
  };
  const auto begin = std::find_if(passed.begin(), passed.end(), [](double p) { return p > 0.0; });
  const std::size_t first =
      low > 0.0 ? reach(low)
                : static_cast<std::size_t>(std::max<std::ptrdiff_t>(begin - passed.begin() - 1, 0));
  const std::size_t last = std::min(reach(high), passed.size() - 1);
  if (last <= first) return {};
  Rate rate{(passed[last] - passed[first]) / (time[last] - time[first]), -1.0};
  if (last - first < 2 * k_parts) return rate;
  double squares = 0.0;
  for (std::size_t p = 0; p < k_parts; ++p) {
    const std::size_t a = first + (last - first) * p / k_parts;
    const std::size_t b = first + (last - first) * (p + 1) / k_parts;
    const double part = (passed[b] - passed[a]) / (time[b] - time[a]);
    squares += (part - rate.value) * (part - rate.value);
  }
  rate.error = std::sqrt(squares / static_cast<double>(k_parts * (k_parts - 1)));
  return rate;
}

}  // namespace dust::model::discharge

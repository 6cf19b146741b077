// SPDX-License-Identifier: Apache-2.0
#include "report/facts/fast_dust.hpp"

#include <algorithm>
#include <cmath>

namespace dust::report {

namespace {

/// Dust may be as fast as what carries it; beyond that it was thrown.
constexpr double k_room = 1.2;
}  // namespace

FastDust fast_dust_of(const H5Source& source, const DustSizes& sizes, double air_speed) {
  FastDust found;
  std::vector<double> dust;
  double carried = air_speed;
  for (const std::string& name : source.frames("/particles")) {
    const std::string path = "/particles/" + name;
    const auto velocity = source.floats(path + "/velocity");
    const auto diameter = source.floats(path + "/diameter");
    for (std::size_t k = 0; 3 * k + 2 < velocity.size() && k < diameter.size(); ++k) {
      const double speed = std::hypot(velocity[3 * k], velocity[3 * k + 1], velocity[3 * k + 2]);
      if (!std::isfinite(speed)) continue;
      if (sizes.is_dust(diameter[k])) {
        dust.push_back(speed);
      } else {
        carried = std::max(carried, speed);
      }
    }
  }
  found.limit = k_room * carried;
  found.all = dust.size();
  found.fast = static_cast<std::size_t>(
      std::count_if(dust.begin(), dust.end(), [&](double speed) { return speed > found.limit; }));
  return found;
}

double stopping_distance(double diameter, double density, double viscosity) {
  if (!(diameter > 0.0 && density > 0.0 && viscosity > 0.0)) return 0.0;
  return k_thrown * density * diameter * diameter / (18.0 * viscosity);
}

}  // namespace dust::report

// SPDX-License-Identifier: Apache-2.0
#include "airborne/resuspension.hpp"

#include "dust/sdk/wind_erosion.hpp"

#include <algorithm>
#include <numeric>

namespace dust::airborne {

Resuspension::Resuspension(const scenario::DustFieldSpec& dust, const Gas& gas, double gravity)
    : coefficient_(dust.resuspension->emission_coefficient),
      gas_density_(gas.density),
      gravity_(gravity) {
  for (const double diameter : dust.diameters) {
    threshold_.push_back(sdk::wind_erosion::threshold(diameter, dust.density, gas.density,
                                                      dust.resuspension->cohesion, gravity));
  }
}

double Resuspension::taken(std::span<const double> layer, std::size_t n, double friction_velocity,
                           double area, double step) const {
  if (!(layer[n] > 0.0)) return 0.0;
  const double whole = std::accumulate(layer.begin(), layer.end(), 0.0);
  const double flux = sdk::wind_erosion::flux(friction_velocity, threshold_[n], gas_density_,
                                              coefficient_, gravity_);
  return std::min(layer[n], flux * area * step * (layer[n] / whole));
}

}  // namespace dust::airborne

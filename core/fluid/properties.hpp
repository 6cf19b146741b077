// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "setup/setup.hpp"

#include <cmath>
#include <vector>

namespace dust::fluid {

/// Density and viscosity of the fluid by place: those of the last region that holds the point, else
/// the fluid's own. Regions stand still; fluid that passes a border takes on the other side's.
/// Points beyond a periodic side have what their images in the domain have.
class Properties {
 public:
  struct Values {
    double density = 0.0;    ///< [kg/m3]
    double viscosity = 0.0;  ///< [Pa s]
  };

  /// Of a domain that begins at `origin`; `period` [m]: its size where it is periodic, else 0.
  explicit Properties(const scenario::FluidSpec& fluid, sdk::Vec3 origin = {},
                      sdk::Vec3 period = {})
      : own_{fluid.density, fluid.viscosity},
        regions_(fluid.regions),
        origin_(origin),
        period_(period) {}

  [[nodiscard]] bool is_uniform() const { return regions_.empty(); }
  [[nodiscard]] const Values& own() const { return own_; }
  [[nodiscard]] Values at(sdk::Vec3 p) const {
    for (int d = 0; d < 3; ++d) {
      if (period_[d] > 0.0) p[d] -= period_[d] * std::floor((p[d] - origin_[d]) / period_[d]);
    }
    for (std::size_t n = regions_.size(); n-- > 0;) {
      const scenario::FluidRegion& r = regions_[n];
      bool is_inside = true;
      for (int d = 0; d < 3; ++d) is_inside &= p[d] >= r.min[d] && p[d] < r.max[d];
      if (is_inside) return {r.density, r.viscosity};
    }
    return own_;
  }

 private:
  Values own_;
  std::vector<scenario::FluidRegion> regions_;
  sdk::Vec3 origin_, period_;
};

}  // namespace dust::fluid

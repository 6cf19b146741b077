// SPDX-License-Identifier: Apache-2.0
#include "fluid/step/flow_limits.hpp"

#include "dust/sdk/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace dust::fluid {
namespace {

constexpr double k_largest_speed = 1e4;  ///< [m/s] beyond this the flow has blown up
constexpr int k_max_sub_steps = 200;

std::string place_text(sdk::Vec3 p, double time) {
  char text[160];
  std::snprintf(text, sizeof text, "at [%.4g, %.4g, %.4g] m, t = %.6g s", p.x, p.y, p.z, time);
  return text;
}

}  // namespace

const FlowLimits::Rates& FlowLimits::find(const FaceField& u, double time) {
  const Rates& rates = rates_.get([&](Rates& r) { r = momentum_.rates(u); });
  check_finite(u, time, rates);
  return rates;
}

int FlowLimits::sub_steps(double left, const Rates& rates, int done, double begin) const {
  const int parts =
      std::max(1, static_cast<int>(std::ceil(left * rates.courant / largest_cfl_ - 1e-9)));
  if (done + parts <= k_max_sub_steps) return parts;
  char text[200];
  std::snprintf(text, sizeof text,
                "the fluid needs more than %d sub-steps in the step from t = %.6g s: largest "
                "speed %.4g m/s; it is diverging, or time.fluid_step is far too long",
                k_max_sub_steps, begin, rates.speed);
  throw sdk::ModelError(text);
}

void FlowLimits::check_finite(const FaceField& u, double time, const Rates& rates) const {
  if (rates.speed <= k_largest_speed) return;
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry_.extent[d];
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) {
          const double v = u.component[d][grid_.index(i, j, k)];
          if (std::abs(v) <= k_largest_speed) continue;
          throw sdk::ModelError(
              std::string("the fluid diverged: velocity component ") + "xyz"[d] +
              (std::isfinite(v) ? " beyond 1e4 m/s " : " is not a number ") +
              place_text(grid_.face(d, i, j, k), time) +
              "; likely causes: a force of grains or a boundary value out of range, or a fluid "
              "step too long for it (shorten time.fluid_step)");
        }
      }
    }
  }
  throw sdk::ModelError("the fluid diverged outside the domain " + place_text(grid_.origin, time));
}

}  // namespace dust::fluid

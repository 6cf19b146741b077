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
/// Of the rate that EddyStress tells times the step: the two stages are stable up to 2 in what they
/// take explicitly.
constexpr double k_explicit = 1.8;

std::string place_text(sdk::Vec3 p) {
  char text[120];
  std::snprintf(text, sizeof text, "at [%.4g, %.4g, %.4g] m", p.x, p.y, p.z);
  return text;
}

}  // namespace

const FlowLimits::Rates& FlowLimits::find(const FaceField& u, double time) {
  const Rates& rates = rates_.get([&](Rates& r) { r = momentum_.rates(u); });
  check_finite(u, time, rates);
  return rates;
}

int FlowLimits::sub_steps(const FaceField& u, double left, const Rates& rates, double diffusion,
                          int done, double begin) const {
  const double wanted = left * std::max(rates.courant / largest_cfl_, diffusion / k_explicit);
  const int parts = std::max(1, static_cast<int>(std::ceil(wanted - 1e-9)));
  if (done + parts <= k_max_sub_steps) return parts;
  const FastFace fastest = first_as_fast_as(rates.speed, u);
  char text[240];
  std::snprintf(text, sizeof text,
                "the fluid needs more than %d sub-steps in the step from t = %.6g s: largest "
                "speed %.4g m/s %s; it is diverging, or time.fluid_step is far too long",
                k_max_sub_steps, begin, rates.speed, place_text(fastest.place).c_str());
  throw sdk::ModelError(text);
}

FlowLimits::FastFace FlowLimits::first_as_fast_as(double speed, const FaceField& u) const {
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry_.extent[d];
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) {
          const std::ptrdiff_t o = grid_.index(i, j, k);
          const double v = u.component[d][o];
          const bool counts = geometry_.kind[d][o] != FaceKind::inside || !std::isfinite(v);
          if (counts && !(std::abs(v) < speed)) return {d, grid_.face(d, i, j, k), v};
        }
      }
    }
  }
  return {0, grid_.origin, speed};
}

void FlowLimits::check_finite(const FaceField& u, double time, const Rates& rates) const {
  if (rates.speed <= k_largest_speed) return;
  const FastFace found = first_as_fast_as(k_largest_speed, u);
  char when[40];
  std::snprintf(when, sizeof when, ", t = %.6g s", time);
  throw sdk::ModelError(
      std::string("the fluid diverged: velocity component ") + "xyz"[found.component] +
      (std::isfinite(found.velocity) ? " beyond 1e4 m/s " : " is not a number ") +
      place_text(found.place) + when +
      "; likely causes: a force of grains or a boundary value out of range, or a fluid "
      "step too long for it (shorten time.fluid_step)");
}

}  // namespace dust::fluid

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/error.hpp>
#include <dust/sdk/sensor.hpp>
#include <dust/sdk/vec3.hpp>

#include <cmath>

namespace dust::model::spillage {

constexpr double k_seconds_per_hour = 3600.0;

/// The axis along which two corners of a level agree. Throws ParameterError where they agree along
/// another one, too, or along none, or lie the wrong way round.
inline int axis_across(sdk::Vec3 min, sdk::Vec3 max) {
  int axis = -1;
  for (int d = 0; d < 3; ++d) {
    if (min[d] == max[d] && axis < 0) {
      axis = d;
    } else if (!(max[d] > min[d])) {
      throw sdk::ParameterError(
          "'max' must lie above 'min' along two axes and agree with it along the third, which "
          "gravity pulls along: a level");
    }
  }
  if (axis < 0) {
    throw sdk::ParameterError(
        "'min' and 'max' must agree along the axis that gravity pulls along: a level");
  }
  return axis;
}

constexpr sdk::Vec3 unit_vector(int axis) {
  return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
}

/// [kg/h] of `mass` [kg] in `duration` [s]; sdk::k_no_value where nothing was observed.
constexpr double per_hour(double mass, double duration) {
  return duration > 0.0 ? k_seconds_per_hour * mass / duration : sdk::k_no_value;
}

/// One standard error [kg] of a counted mass: grains that come one by one scatter like a Poisson
/// count, \f$ \sigma = \sqrt{\sum (w m)^2} \f$; below 0: nothing came, there is no estimate.
inline double error_of(double squares) { return squares > 0.0 ? std::sqrt(squares) : -1.0; }

}  // namespace dust::model::spillage

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/error.hpp>
#include <dust/sdk/parameter_schema.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::model {

/// A speed that is reached in a straight ramp, held, and lost at once at a time or after a way:
/// with \f$ \tau = t - t_0 \f$ the way is \f$ u \tau^2 / (2 r) \f$ while \f$ \tau < r \f$ and
/// \f$ u (\tau - r/2) \f$ afterwards. `speed` > 0, or of either sign
/// without a `limit`; way and speed in any consistent unit.
struct Course {
  double speed = 0.0;
  double start = 0.0;                                      ///< [s]
  double ramp = 0.0;                                       ///< [s]
  double stop = std::numeric_limits<double>::infinity();   ///< [s]
  double limit = std::numeric_limits<double>::infinity();  ///< of the way

  /// Time [s] at which the motion ends.
  [[nodiscard]] double end() const {
    if (limit == std::numeric_limits<double>::infinity()) return stop;
    const double on_ramp = 0.5 * speed * ramp;
    const double lasts =
        limit < on_ramp ? std::sqrt(2.0 * limit * ramp / speed) : limit / speed + 0.5 * ramp;
    return std::min(stop, start + lasts);
  }
  [[nodiscard]] double way(double time) const {
    const double tau = std::max(0.0, std::min(time, end()) - start);
    const double way = tau < ramp ? 0.5 * speed * tau * tau / ramp : speed * (tau - 0.5 * ramp);
    // The end of the way is met to the last bit.
    return time >= end() && end() < stop ? limit : way;
  }
  [[nodiscard]] double speed_at(double time) const {
    if (time < start || time >= end()) return 0.0;
    const double tau = time - start;
    return tau < ramp ? speed * tau / ramp : speed;
  }
};

/// When a motion sets off, and how fast it gathers speed: the `Parameters` of a motion derive from
/// this.
struct StartParameters {
  double start = 0.0;  ///< [s]
  double ramp = 0.0;   ///< [s]
};
template <class P>
void declare_start(sdk::SchemaOf<P>& s) {
  s.number(&P::start, "start", sdk::dimension::time, "Time at which it sets off.")
      .symbol("t_0")
      .at_least(0)
      .optional();
}
template <class P>
void declare_ramp(sdk::SchemaOf<P>& s) {
  s.number(&P::ramp, "ramp", sdk::dimension::time, "Time in which it gathers speed, evenly.")
      .symbol("r")
      .at_least(0)
      .optional();
}

/// The same for motions that end.
struct CourseParameters : StartParameters {
  double stop = std::numeric_limits<double>::infinity();  ///< [s]

  /// `limit` is the way after which the motion ends.
  [[nodiscard]] Course course(double speed, double limit) const {
    if (stop <= start) throw sdk::ParameterError("stop is not after start");
    return {.speed = speed, .start = start, .ramp = ramp, .stop = stop, .limit = limit};
  }
};
template <class P>
void declare_stop(sdk::SchemaOf<P>& s) {
  s.number(&P::stop, "stop", sdk::dimension::time, "Time at which it stops.")
      .at_least(0)
      .optional();
}

}  // namespace dust::model

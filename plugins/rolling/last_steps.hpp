// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace dust::model {

/// The couple over the last steps of a contact, x steps before its end. Its spring weakens like the
/// root of the overlap, so it goes like \f$ M_e + c x^{3/2} \f$ until its limit, which goes like
/// the normal force, \f$ L x^{3/2} \f$, cuts it off. That takes a step or so, and one that is
/// looked at once per step does not see it; what the last two looks give in place of the couple
/// adds up to the integral; docs/theory/grains.md, eq. (16).
class CoupleToTheEnd {
 public:
  /// At x = `steps`: the couple without limit [N m], what it has grown by in the last step, and
  /// the limit.
  CoupleToTheEnd(double steps, double couple, double growth, double limit) {
    const double power = steps * std::sqrt(steps);
    slope_ = limit / power;
    change_ = -growth / (1.5 * std::sqrt(steps + 0.5));
    change_ = std::clamp(change_, -slope_, 0.9 * std::min(slope_, couple / power));
    left_ = couple - change_ * power;
  }
  /// What is given at x as the last one or the last but one.
  [[nodiscard]] double at(double x) const {
    if (x <= 1.0) return last(x);
    return std::clamp(integral(x) - last(x - 1.0), 0.0, limit(x));
  }

 private:
  [[nodiscard]] double limit(double x) const { return slope_ * x * std::sqrt(x); }
  /// It fades where the end is near: whether there is one more look hangs on the last digits there.
  [[nodiscard]] double last(double x) const {
    return std::min(std::min(1.0, x / 0.7) * integral(x), limit(x));
  }
  /// From the end to half a step before x, steps being the unit.
  [[nodiscard]] double integral(double x) const {
    const double begin = x + 0.5;
    // The limit is reached at x_c, if it is not yet.
    double from = begin;
    if (left_ < (slope_ - change_) * begin * std::sqrt(begin)) {
      const double root = std::cbrt(left_ / (slope_ - change_));
      from = root * root;
    }
    const auto power = [](double y) { return 0.4 * y * y * std::sqrt(y); };
    return slope_ * power(from) + left_ * (begin - from) + change_ * (power(begin) - power(from));
  }

  double slope_;   ///< [N m] L
  double change_;  ///< [N m] c
  double left_;    ///< [N m] M_e
};

/// What is left of a rolling spring in a step, and the part of the step that turns it.
struct SpringPart {
  double kept, of_step;
};

/// A damped contact pulls before it ends. Where its normal force goes through zero, so does the
/// limit of the couple: the spring begins anew. `normal_force` [N] now, `fall` [N] by how much it
/// has fallen in the step.
[[gnu::always_inline]] inline SpringPart part_since_pulling(double normal_force, double fall) {
  const bool begins = normal_force < 0.0 && normal_force + fall > 0.0;
  return {begins ? 0.0 : 1.0, begins ? -normal_force / std::max(fall, 1e-290) : 1.0};
}

/// A contact of a rolling law.
struct PartingContact {
  double couple;        ///< [N m] without its limit
  double before;        ///< [N m] a step ago
  double limit;         ///< [N m]
  double overlap;       ///< [m]
  double speed;         ///< [m/s] of parting, half a step ago
  double normal_force;  ///< [N]
  double mass;          ///< [kg] effective
};

/// Below zero where change_at_the_end() is to be asked, by the `way` [m] that the two part in a
/// step. What has no couple, as pairs that only are within reach of a bridge, has nothing to
/// change.
[[gnu::always_inline]] inline double distance_from_end(double couple, double overlap, double way) {
  return couple > 0.0 ? overlap - 2.0 * way : 0.0;
}

/// What the limited couple is to be multiplied by; 1 unless the contact ends within two steps.
inline double change_at_the_end(const PartingContact& c, double time_step) {
  // Of the way to the end: still pushed apart.
  const double speed = c.speed + 0.5 * time_step * c.normal_force / c.mass;
  const double steps = c.overlap / (speed * time_step);
  if (!(steps > 0.0 && steps < 2.0 && c.couple > 0.0 && c.limit > 0.0)) return 1.0;
  const CoupleToTheEnd end(steps, c.couple, c.couple - c.before, c.limit);
  const double share = end.at(steps) / c.couple;
  if (share < 0.0) return 1.0;
  return std::min(share * c.couple, c.limit) / std::min(c.couple, c.limit);
}

}  // namespace dust::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/contact_law.hpp>
#include <dust/sdk/parameter_schema.hpp>

namespace dust::model {

/// What rolling laws share whose only material number is the coefficient of rolling friction.
class RollingFriction : public sdk::RollingLaw {
 public:
  struct Parameters {
    double friction = 0.0;
  };
  void prepare(const sdk::MaterialProperties&, const sdk::MaterialProperties&) override {}

 protected:
  explicit RollingFriction(const Parameters& p) : friction_(p.friction) {}
  [[nodiscard]] double friction() const { return friction_; }

 private:
  double friction_;
};

/// `what` says how the couple depends on it.
template <class P>
void declare_rolling_friction(sdk::SchemaOf<P>& s, const char* what) {
  s.number(&P::friction, "friction", sdk::dimension::none, what)
      .symbol("\\mu_r")
      .at_least(0)
      .usual(0, 2);
}

inline constexpr const char* k_couple_is_bounded =
    "Coefficient of rolling friction: the couple never exceeds it times R* times the normal force.";

}  // namespace dust::model

// SPDX-License-Identifier: Apache-2.0
#include "my_boundary.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_boundary;
namespace sdk = dust::sdk;

class MyBoundary final : public sdk::BoundaryCondition {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    sdk::Vec3 velocity;
    double gusts = 0.0;
    double frequency = 1.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::velocity, "velocity", sdk::dimension::velocity,
             "Mean velocity of the wind on this side.")
        .symbol("u");
    s.number(&Parameters::gusts, "gusts", sdk::dimension::none,
             "Strength of the gusts relative to the mean.")
        .symbol("a")
        .at_least(0)
        .optional();
    s.number(&Parameters::frequency, "frequency", sdk::dimension::frequency, "Gusts per time.")
        .symbol("f")
        .at_least(0)
        .optional();
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_boundary",
            .version = "1.0",
            .summary = "Wind of a given velocity with regular gusts.",
            .equation = "u_b = u (1 + a \\sin 2 \\pi f t), \\quad \\partial p / \\partial n = 0",
            .source = "own definition"};
  }

  explicit MyBoundary(const Parameters& p) : p_(p) {}

  // 3. What the solver does on this side: velocity given, pressure follows.
  [[nodiscard]] sdk::SideRules rules() const override {
    return {.normal_velocity = sdk::SideRule::fixed,
            .tangential_velocity = sdk::SideRule::fixed,
            .pressure = sdk::SideRule::gradient};
  }
  // 4. The values: a pure function of time and place.
  void evaluate(const sdk::SideBatch& batch) const override {
    const double strength = formula::strength(p_.gusts, p_.frequency, batch.time);
    for (std::size_t n = 0; n < batch.count; ++n) {
      batch.velocity.x[n] = strength * p_.velocity.x;
      batch.velocity.y[n] = strength * p_.velocity.y;
      batch.velocity.z[n] = strength * p_.velocity.z;
    }
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyBoundary>(); }

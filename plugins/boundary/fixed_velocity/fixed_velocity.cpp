// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/plugin.hpp>

namespace {

namespace sdk = dust::sdk;

class FixedVelocity final : public sdk::BoundaryCondition {
 public:
  struct Parameters {
    sdk::Vec3 velocity;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::velocity, "velocity", sdk::dimension::velocity,
             "Interstitial velocity of the fluid on the side.")
        .symbol("u_w");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "fixed_velocity",
            .version = "1.0",
            .summary = "Inlet or outlet with a given velocity.",
            .equation = R"(u = u_w, \quad \partial p/\partial n = 0)",
            .source = "Dirichlet condition; docs/theory/fluid.md, section 4"};
  }

  explicit FixedVelocity(const Parameters& p) : p_(p) {}

  [[nodiscard]] sdk::SideRules rules() const override {
    return {.normal_velocity = sdk::SideRule::fixed,
            .tangential_velocity = sdk::SideRule::fixed,
            .pressure = sdk::SideRule::gradient};
  }
  void evaluate(const sdk::SideBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) {
      batch.velocity.set(n, p_.velocity);
    }
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<FixedVelocity>(); }

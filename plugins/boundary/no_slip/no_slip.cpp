// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/plugin.hpp>

namespace {

namespace sdk = dust::sdk;

class NoSlip final : public sdk::BoundaryCondition {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return {}; }
  static sdk::ModelInfo describe() {
    return {.name = "no_slip",
            .version = "1.0",
            .summary = "Wall at rest to which the fluid sticks.",
            .equation = R"(u = 0, \quad \partial p/\partial n = 0)",
            .source = "no-slip condition; docs/theory/fluid.md, section 4"};
  }

  explicit NoSlip(const Parameters&) {}

  [[nodiscard]] sdk::SideRules rules() const override {
    return {.normal_velocity = sdk::SideRule::fixed,
            .tangential_velocity = sdk::SideRule::fixed,
            .pressure = sdk::SideRule::gradient};
  }
  void evaluate(const sdk::SideBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) {
      batch.velocity.set(n, {});
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<NoSlip>(); }

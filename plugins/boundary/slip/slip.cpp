// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/plugin.hpp>

namespace {

namespace sdk = dust::sdk;

class Slip final : public sdk::BoundaryCondition {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return {}; }
  static sdk::ModelInfo describe() {
    return {.name = "slip",
            .version = "1.0",
            .summary = "Frictionless wall or plane of symmetry.",
            .equation =
                R"(u_n = 0, \quad \partial u_t/\partial n = 0, \quad \partial p/\partial n = 0)",
            .source = "symmetry; docs/theory/fluid.md, section 4"};
  }

  explicit Slip(const Parameters&) {}

  [[nodiscard]] sdk::SideRules rules() const override {
    return {.normal_velocity = sdk::SideRule::fixed,
            .tangential_velocity = sdk::SideRule::gradient,
            .pressure = sdk::SideRule::gradient};
  }
  void evaluate(const sdk::SideBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) {
      batch.velocity.set(n, {});
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Slip>(); }

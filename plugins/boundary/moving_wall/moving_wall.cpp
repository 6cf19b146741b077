// SPDX-License-Identifier: Apache-2.0
#include "moving_wall.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::moving_wall;
namespace sdk = dust::sdk;

class MovingWall final : public sdk::BoundaryCondition {
 public:
  struct Parameters {
    sdk::Vec3 velocity;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::velocity, "velocity", sdk::dimension::velocity,
             "Velocity of the wall; only its part along the wall acts.")
        .symbol("u_w");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "moving_wall",
            .version = "1.0",
            .summary = "Wall that moves in its own plane and drags the fluid along.",
            .equation = R"(u = u_w - (u_w \cdot n) n, \quad \partial p/\partial n = 0)",
            .source = "no-slip condition; docs/theory/fluid.md, section 4"};
  }

  explicit MovingWall(const Parameters& p) : p_(p) {}

  [[nodiscard]] sdk::SideRules rules() const override {
    return {.normal_velocity = sdk::SideRule::fixed,
            .tangential_velocity = sdk::SideRule::fixed,
            .pressure = sdk::SideRule::gradient};
  }
  void evaluate(const sdk::SideBatch& batch) const override {
    const sdk::Vec3 w = p_.velocity;
    const sdk::Vec3 n = batch.normal;
    const double through = dot(w, n);
    for (std::size_t i = 0; i < batch.count; ++i) {
      batch.velocity.x[i] = formula::along(w.x, n.x, through);
      batch.velocity.y[i] = formula::along(w.y, n.y, through);
      batch.velocity.z[i] = formula::along(w.z, n.z, through);
    }
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MovingWall>(); }

// SPDX-License-Identifier: Apache-2.0
#include "belt.hpp"

#include <dust/sdk/plugin.hpp>

#include <cmath>

namespace {

namespace sdk = dust::sdk;

class Belt final : public sdk::Motion {
 public:
  struct Parameters {
    double speed = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::speed, "speed", sdk::dimension::velocity,
             "Speed of the belt; positive carries towards +x on top for a pulley axis along +y.")
        .symbol("U");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "belt",
            .version = "1.0",
            .summary = "A surface that runs along itself round the body's lateral axis.",
            .equation = "v = U\\, a \\times n",
            .source = "kinematics of an inextensible belt; own derivation"};
  }

  explicit Belt(const Parameters& p) : speed_(p.speed) {}
  void surface_velocity(const sdk::SurfaceBatch& b) const override {
    for (std::size_t q = 0; q < b.count; ++q) {
      const auto v = dust::model::belt::velocity(speed_, b.axis.x, b.axis.y, b.axis.z,
                                                 b.normal_x[q], b.normal_y[q], b.normal_z[q]);
      b.velocity_x[q] = v.x;
      b.velocity_y[q] = v.y;
      b.velocity_z[q] = v.z;
    }
  }
  [[nodiscard]] double largest_speed() const override { return std::abs(speed_); }

 private:
  double speed_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Belt>(); }

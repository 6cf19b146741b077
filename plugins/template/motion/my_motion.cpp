// SPDX-License-Identifier: Apache-2.0
#include "my_motion.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_motion;
namespace sdk = dust::sdk;

class MyMotion final : public sdk::Motion {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    sdk::Vec3 velocity;
    double frequency = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::velocity, "velocity", sdk::dimension::velocity,
             "Largest velocity of the surface; only its part along the surface acts.")
        .symbol("v");
    s.number(&Parameters::frequency, "frequency", sdk::dimension::frequency,
             "Strokes per time; 0 = steady.")
        .symbol("f")
        .at_least(0)
        .optional();
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_motion",
            .version = "1.0",
            .summary = "A surface that slides to and fro along itself.",
            .equation = "u = (v - (v \\cdot n) n) \\cos 2 \\pi f t",
            .source = "own definition"};
  }

  explicit MyMotion(const Parameters& p) : p_(p) {}

  // 3. Velocity of the surface: a pure function of time and place.
  void surface_velocity(const sdk::SurfaceBatch& batch) const override {
    const double phase = formula::phase(p_.frequency, batch.time);
    for (std::size_t n = 0; n < batch.count; ++n) {
      const sdk::Vec3 normal = batch.normal[n];
      const sdk::Vec3 v = phase * (p_.velocity - dot(p_.velocity, normal) * normal);
      batch.velocity.set(n, v);
    }
  }
  // 4. Its bound, for time steps and checks.
  [[nodiscard]] double largest_speed() const override { return norm(p_.velocity); }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyMotion>(); }

// SPDX-License-Identifier: Apache-2.0
#include "my_rolling.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_rolling;
namespace sdk = dust::sdk;

DUST_KERNEL void evaluate_batch(double friction, double smooth_below, const sdk::ContactBatch& b) {
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    formula::Rolling c{b.normal.x[q],
                       b.normal.y[q],
                       b.normal.z[q],
                       b.angular_velocity.x[q],
                       b.angular_velocity.y[q],
                       b.angular_velocity.z[q],
                       b.effective_radius[q],
                       b.normal_force[q],
                       0.0,
                       0.0,
                       0.0};
    formula::evaluate(friction, smooth_below, c);
    b.torque.x[q] = c.mx;
    b.torque.y[q] = c.my;
    b.torque.z[q] = c.mz;
  }
}

class MyRolling final : public sdk::RollingLaw {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    double friction = 0.0;
    double smooth_below = 10.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::friction, "friction", sdk::dimension::none,
             "Coefficient of rolling friction.")
        .symbol("\\mu_r")
        .at_least(0);
    s.number(&Parameters::smooth_below, "smooth_below", sdk::dimension::angular_velocity,
             "Rotation below which the couple fades, so that a grain can come to rest.")
        .symbol("w_0")
        .above(0)
        .optional();
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_rolling",
            .version = "1.0",
            .summary = "A constant couple against rolling, smooth through rest.",
            .equation = "M = -\\mu_r R^* |F_n| w_r / \\sqrt{w_r^2 + w_0^2}",
            .source =
                "Ai, Chen, Rotter, Ooi, Powder Technol. 206 (2011) 269, model A, smoothed, "
                "doi:10.1016/j.powtec.2010.09.030"};
  }

  explicit MyRolling(const Parameters& p) : p_(p) {}

  // 3. The pair of materials, once; this law does not need them. It keeps nothing per contact.
  void prepare(const sdk::MaterialProperties&, const sdk::MaterialProperties&) override {}
  [[nodiscard]] int history_size() const override { return 0; }
  // 4. The law on a batch, after the contact stage has written the normal force.
  void evaluate(const sdk::ContactBatch& batch) const override {
    evaluate_batch(p_.friction, p_.smooth_below, batch);
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyRolling>(); }

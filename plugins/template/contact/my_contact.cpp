// SPDX-License-Identifier: Apache-2.0
#include "my_contact.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_contact;
namespace sdk = dust::sdk;

DUST_KERNEL void evaluate_batch(const formula::Constants& constants, const sdk::ContactBatch& b) {
  const formula::Constants k = constants;
  double *sx = b.history[0], *sy = b.history[1], *sz = b.history[2];
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    formula::Contact c{b.overlap[q],
                       b.normal.x[q],
                       b.normal.y[q],
                       b.normal.z[q],
                       b.velocity.x[q],
                       b.velocity.y[q],
                       b.velocity.z[q],
                       b.displacement.x[q],
                       b.displacement.y[q],
                       b.displacement.z[q],
                       b.effective_mass[q],
                       sx[q],
                       sy[q],
                       sz[q],
                       0.0,
                       0.0,
                       0.0,
                       0.0,
                       0.0};
    formula::evaluate(k, c);
    sx[q] = c.sx;
    sy[q] = c.sy;
    sz[q] = c.sz;
    b.normal_force[q] = c.normal_force;
    b.normal_stiffness[q] = k.stiffness;
    b.tangential_stiffness[q] = c.tangential_stiffness;
    b.force.x[q] = c.fx;
    b.force.y[q] = c.fy;
    b.force.z[q] = c.fz;
  }
}

class MyContact final : public sdk::ContactLaw {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    double stiffness = 0.0;
    double stiffness_ratio = 2.0 / 7.0;
    double restitution = 0.0;
    double friction = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::stiffness, "stiffness", sdk::dimension::stiffness,
             "Stiffness of the normal spring.")
        .symbol("k")
        .above(0);
    s.number(&Parameters::stiffness_ratio, "stiffness_ratio", sdk::dimension::none,
             "Tangential over normal stiffness.")
        .symbol("k_t / k")
        .at_least(0)
        .at_most(1)
        .optional();
    s.number(&Parameters::restitution, "restitution", sdk::dimension::none,
             "Ratio of the speeds after and before a head-on collision.")
        .symbol("e")
        .above(0)
        .at_most(1);
    s.number(&Parameters::friction, "friction", sdk::dimension::none,
             "Coefficient of sliding friction.")
        .symbol("\\mu")
        .at_least(0);
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_contact",
            .version = "1.0",
            .summary = "Linear springs and dampers with Coulomb friction.",
            .equation =
                "F_n = k d - c v_n,\\quad F_t = -k_t s - c_t v_t,\\quad "
                "|F_t| \\le \\mu \\max(F_n, 0)",
            .source = "Cundall, Strack, Geotechnique 29 (1979) 47, doi:10.1680/geot.1979.29.1.47"};
  }

  explicit MyContact(const Parameters& p)
      : constants_{p.stiffness, p.stiffness_ratio, formula::damping(p.restitution), p.friction} {}

  // 3. The pair of materials, once; this law does not need them.
  void prepare(const sdk::MaterialProperties&, const sdk::MaterialProperties&) override {}
  // 4. What the core shall keep for each contact: the tangential spring.
  [[nodiscard]] int history_size() const override { return 3; }
  // 5. The law on a batch: columns in, columns out; no allocation, no lock.
  void evaluate(const sdk::ContactBatch& batch) const override {
    evaluate_batch(constants_, batch);
  }
  // 6. Times from which the core derives the steps.
  [[nodiscard]] double collision_time(double, double mass, double) const override {
    return formula::collision_time(constants_.stiffness, mass);
  }
  [[nodiscard]] double half_period(double, double mass, double) const override {
    return formula::collision_time(constants_.stiffness, mass);
  }

 private:
  formula::Constants constants_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyContact>(); }

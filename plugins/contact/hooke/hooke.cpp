// SPDX-License-Identifier: Apache-2.0
#include "hooke.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::hooke;
namespace sdk = dust::sdk;

DUST_KERNEL void evaluate_batch(const formula::Constants& constants, const sdk::ContactBatch& b) {
  const formula::Constants k = constants;
  const double *overlap = b.overlap, *nx = b.normal.x, *ny = b.normal.y, *nz = b.normal.z;
  const double *vx = b.velocity.x, *vy = b.velocity.y, *vz = b.velocity.z;
  const double *ux = b.displacement.x, *uy = b.displacement.y, *uz = b.displacement.z;
  const double* mass = b.effective_mass;
  double *sx = b.history[0], *sy = b.history[1], *sz = b.history[2];
  double *fn = b.normal_force, *kn = b.normal_stiffness, *kt = b.tangential_stiffness;
  double *fx = b.force.x, *fy = b.force.y, *fz = b.force.z;
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    formula::Contact c{overlap[q], nx[q], ny[q], nz[q], vx[q], vy[q], vz[q], ux[q], uy[q], uz[q],
                       mass[q],    sx[q], sy[q], sz[q], 0.0,   0.0,   0.0,   0.0,   0.0,   0.0};
    formula::evaluate(k, b.time_step, c);
    sx[q] = c.sx;
    sy[q] = c.sy;
    sz[q] = c.sz;
    fn[q] = c.normal_force;
    kn[q] = c.normal_stiffness;
    kt[q] = c.tangential_stiffness;
    fx[q] = c.fx;
    fy[q] = c.fy;
    fz[q] = c.fz;
  }
}

/// Linear spring-dashpot with Coulomb friction.
class Hooke final : public sdk::ContactLaw {
 public:
  struct Parameters {
    double normal_stiffness = 0.0;
    double tangential_stiffness_ratio = 2.0 / 7.0;
    double restitution = 0.0;
    double friction = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::normal_stiffness, "normal_stiffness", sdk::dimension::stiffness,
             "Stiffness of the normal spring, the same for grains of every size.")
        .symbol("k_n")
        .above(0);
    s.number(&Parameters::tangential_stiffness_ratio, "tangential_stiffness_ratio",
             sdk::dimension::none,
             "Tangential over normal stiffness; at 2/7 both directions swing with one period.")
        .symbol("k_t/k_n")
        .above(0)
        .at_most(1)
        .optional();
    s.number(&Parameters::restitution, "restitution", sdk::dimension::none,
             "Ratio of the speeds after and before a head-on collision.")
        .symbol("e")
        .above(0)
        .at_most(1);
    s.number(&Parameters::friction, "friction", sdk::dimension::none,
             "Coulomb's coefficient: the tangential force never exceeds it times the normal one.")
        .symbol("\\mu_s")
        .at_least(0)
        .usual(0, 2);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "hooke",
        .version = "2.0",
        .summary = "Linear spring and dashpot, normal and tangential, with Coulomb friction.",
        .equation =
            "F_n = k_n d - \\gamma_n v_n,\\quad F_t = -k_t \\xi_t - \\gamma_t v_t,\\quad "
            "|F_t| \\le \\mu_s \\max(F_n, 0)",
        .source = "Cundall and Strack, Geotechnique 29 (1979) 47, doi:10.1680/geot.1979.29.1.47"};
  }

  explicit Hooke(const Parameters& p) {
    constants_.stiffness = p.normal_stiffness;
    constants_.tangential_stiffness = p.tangential_stiffness_ratio * p.normal_stiffness;
    constants_.damping = formula::damping(p.restitution);
    constants_.friction = p.friction;
  }

  void prepare(const sdk::MaterialProperties&, const sdk::MaterialProperties&) override {}
  [[nodiscard]] int history_size() const override { return 3; }
  void evaluate(const sdk::ContactBatch& batch) const override {
    evaluate_batch(constants_, batch);
  }
  [[nodiscard]] double collision_time(double, double mass, double) const override {
    return formula::collision_time(constants_.stiffness, constants_.damping, mass);
  }
  [[nodiscard]] double half_period(double, double mass, double) const override {
    return formula::elastic_time(constants_.stiffness, mass);
  }

 private:
  formula::Constants constants_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Hooke>(); }

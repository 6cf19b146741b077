// SPDX-License-Identifier: Apache-2.0
#include "epsd2.hpp"

#include "../friction.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::epsd2;
namespace sdk = dust::sdk;

DUST_KERNEL void evaluate_batch(double friction, const sdk::ContactBatch &b) {
  const double time_step = b.time_step;
  const double *nx = b.normal_x, *ny = b.normal_y, *nz = b.normal_z;
  const double *wx = b.rotation_x, *wy = b.rotation_y, *wz = b.rotation_z;
  const double *radius = b.effective_radius, *fn = b.normal_force, *kt = b.tangential_stiffness;
  double *mx = b.history[0], *my = b.history[1], *mz = b.history[2];
  double *tx = b.torque_x, *ty = b.torque_y, *tz = b.torque_z;
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    formula::Rolling c{nx[q],     ny[q], nz[q], wx[q], wy[q], wz[q],
                       radius[q], fn[q], kt[q], mx[q], my[q], mz[q]};
    formula::evaluate(friction, time_step, c);
    mx[q] = c.mx;
    my[q] = c.my;
    mz[q] = c.mz;
    tx[q] = c.mx;
    ty[q] = c.my;
    tz[q] = c.mz;
  }
}

class Epsd2 final : public dust::model::RollingFriction {
 public:
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    dust::model::declare_rolling_friction(s, dust::model::k_couple_is_bounded);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "epsd2",
            .version = "1.0",
            .summary = "Elastic-plastic rolling spring without dashpot.",
            .equation =
                "\\Delta M = -k_t R^{*2} \\Delta\\theta_r,\\quad "
                "|M| \\le \\mu_r R^* |F_n|",
            .source =
                "Ai, Chen, Rotter, Ooi, Powder Technol. 206 (2011) 269 (model C), "
                "doi:10.1016/j.powtec.2010.09.030; Wensrich and Katterfeld, Powder Technol. "
                "217 (2012) 409, doi:10.1016/j.powtec.2011.10.057"};
  }

  explicit Epsd2(const Parameters &p) : RollingFriction(p) {}
  [[nodiscard]] int history_size() const override { return 3; }
  void evaluate(const sdk::ContactBatch &batch) const override {
    evaluate_batch(friction(), batch);
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Epsd2>(); }

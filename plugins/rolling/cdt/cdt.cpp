// SPDX-License-Identifier: Apache-2.0
#include "cdt.hpp"

#include "../friction.hpp"

#include <dust/sdk/plugin.hpp>

#include <string>

namespace {

namespace formula = dust::model::cdt;
namespace sdk = dust::sdk;

using formula::NormalisedBy;

template <NormalisedBy by>
[[gnu::always_inline]] inline void evaluate_rows(double friction, const sdk::ContactBatch& b) {
  const double time_step = b.time_step;
  const double *nx = b.normal.x, *ny = b.normal.y, *nz = b.normal.z;
  const double *wx = b.angular_velocity.x, *wy = b.angular_velocity.y, *wz = b.angular_velocity.z;
  const double *radius = b.effective_radius, *mass = b.effective_mass, *fn = b.normal_force;
  double *tx = b.torque.x, *ty = b.torque.y, *tz = b.torque.z;
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    formula::Rolling c{nx[q],     ny[q],   nz[q], wx[q], wy[q], wz[q],
                       radius[q], mass[q], fn[q], 0.0,   0.0,   0.0};
    formula::evaluate<by>(friction, time_step, c);
    tx[q] = c.mx;
    ty[q] = c.my;
    tz[q] = c.mz;
  }
}

DUST_KERNEL void evaluate_batch(double friction, const sdk::ContactBatch& b) {
  evaluate_rows<NormalisedBy::rolling>(friction, b);
}

DUST_KERNEL void evaluate_normalised_whole(double friction, const sdk::ContactBatch& b) {
  evaluate_rows<NormalisedBy::rotation>(friction, b);
}

class Cdt final : public dust::model::RollingFriction {
 public:
  struct Parameters : RollingFriction::Parameters {
    std::string about_normal = "apart";
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    dust::model::declare_rolling_friction(
        s, "Coefficient of rolling friction: the couple is it times R* times the normal force.");
    s.text(&Parameters::about_normal, "twist",
           "Rotation about the normal: apart, or liggghts, where it makes the couple smaller "
           "because the relative rotation is normalised with it.")
        .one_of({"apart", "liggghts"})
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "cdt",
        .version = "1.0",
        .summary =
            "Constant couple against the relative rolling velocity. Holds no grain on a slope: it "
            "creeps at 20 g sin(theta) dt. For heaps and grains at rest take epsd2.",
        .equation = "M = -\\mu_r R^* |F_n|\\,\\omega_r / |\\omega_r|",
        .source =
            "Ai, Chen, Rotter, Ooi, Powder Technol. 206 (2011) 269 (model A), "
            "doi:10.1016/j.powtec.2010.09.030; Zhou, Wright, Yang, Xu, Yu, Physica A 269 "
            "(1999) 536, doi:10.1016/S0378-4371(99)00183-1"};
  }

  explicit Cdt(const Parameters& p) : RollingFriction(p), is_whole_(p.about_normal == "liggghts") {}
  [[nodiscard]] int history_size() const override { return 0; }
  void evaluate(const sdk::ContactBatch& batch) const override {
    is_whole_ ? evaluate_normalised_whole(friction(), batch) : evaluate_batch(friction(), batch);
  }

 private:
  bool is_whole_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Cdt>(); }

// SPDX-License-Identifier: Apache-2.0
#include "magnus.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::magnus;
namespace sdk = dust::sdk;

class Magnus final : public sdk::FluidForce {
 public:
  struct Parameters {
    std::string form = "rubinow_keller";
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.text(&Parameters::form, "form",
           "Law of Rubinow and Keller for slow grains, or the one fitted by Oesterle and Bui Dinh.")
        .one_of({"rubinow_keller", "oesterle"})
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "magnus",
        .version = "1.0",
        .summary = "Lift of a grain that spins.",
        .equation =
            R"(f = \frac{\pi}{8} D^3 \rho_f\, \Omega \times w,\ \Omega = \frac12 \nabla \times u_f - \omega_p)",
        .source =
            "Rubinow, Keller, J. Fluid Mech. 11 (1961) 447-459, doi:10.1017/S0022112061000640; "
            "Oesterle, Bui Dinh, Exp. Fluids 25 (1998) 16-22, doi:10.1007/s003480050203"};
  }
  explicit Magnus(const Parameters& p) : is_oesterle_(p.form == "oesterle") {}

  void evaluate(const sdk::FluidForceBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      const sdk::Vec3 slip = batch.slip[g];
      const sdk::Vec3 spin = 0.5 * batch.vorticity[g] - batch.angular_velocity[g];
      const double diameter = batch.diameter[g];
      const double density = batch.density[g];
      sdk::Vec3 f = formula::force(diameter, density, spin, slip);
      const double speed = norm(slip);
      const double turning = norm(spin);
      if (is_oesterle_ && speed > 0.0 && turning > 0.0) {
        const double scale = density * diameter / batch.viscosity[g];
        f = formula::oesterle_factor(scale * speed, scale * diameter * turning) * f;
      }
      batch.force.set(g, f);
    }
  }
  [[nodiscard]] sdk::FluidForceNeeds needs() const override { return {.vorticity = true}; }

 private:
  bool is_oesterle_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Magnus>(); }

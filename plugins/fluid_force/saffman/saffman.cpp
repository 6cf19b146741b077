// SPDX-License-Identifier: Apache-2.0
#include "saffman.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::saffman;
namespace sdk = dust::sdk;

class Saffman final : public sdk::FluidForce {
 public:
  struct Parameters {
    std::string form = "saffman";
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.text(&Parameters::form, "form",
           "Saffman's law for slow grains, or with Mei's factor for finite Reynolds numbers.")
        .one_of({"saffman", "mei"})
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "saffman",
        .version = "1.0",
        .summary = "Lift of a grain that slips in a shear flow.",
        .equation =
            R"(f = 1.615 D^2 \sqrt{\rho_f \mu / |\omega|}\; w \times \omega,\ \omega = \nabla \times u_f)",
        .source =
            "Saffman, J. Fluid Mech. 22 (1965) 385-400, doi:10.1017/S0022112065000824; corrigendum "
            "31 "
            "(1968) 624; Mei, Int. J. Multiphase Flow 18 (1992) 145-147, "
            "doi:10.1016/0301-9322(92)90012-6"};
  }
  explicit Saffman(const Parameters& p) : is_mei_(p.form == "mei") {}

  void evaluate(const sdk::FluidForceBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      const sdk::Vec3 slip = batch.slip[g];
      const sdk::Vec3 vorticity = batch.vorticity[g];
      const double diameter = batch.diameter[g];
      sdk::Vec3 f = formula::force(diameter, batch.density[g], batch.viscosity[g], slip, vorticity);
      const double speed = norm(slip);
      if (is_mei_ && speed > 0.0) {
        const double reynolds = batch.density[g] * speed * diameter / batch.viscosity[g];
        f = formula::mei_factor(reynolds, 0.5 * diameter * norm(vorticity) / speed) * f;
      }
      batch.force.set(g, f);
    }
  }
  [[nodiscard]] sdk::FluidForceNeeds needs() const override { return {.vorticity = true}; }

 private:
  bool is_mei_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Saffman>(); }

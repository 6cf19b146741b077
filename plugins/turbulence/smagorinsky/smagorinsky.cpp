// SPDX-License-Identifier: Apache-2.0
#include "smagorinsky.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::smagorinsky;
namespace sdk = dust::sdk;

class Smagorinsky final : public sdk::TurbulenceModel {
 public:
  struct Parameters {
    double coefficient = 0.17;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::coefficient, "coefficient", sdk::dimension::none,
             "Size of the mixing eddies over that of a cell: 0.17 in decaying turbulence, 0.1 in "
             "channels.")
        .symbol("C_s")
        .above(0)
        .at_most(0.3)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "smagorinsky",
        .version = "1.0",
        .summary = "Eddy viscosity of the eddies smaller than a cell.",
        .equation =
            R"(\mu_t = \rho_f\, l^2 |S|,\ l = \min(C_s \Delta, 0.41\, d),\ |S| = \sqrt{2 S_{ij} S_{ij}})",
        .source =
            "Smagorinsky, Mon. Weather Rev. 91 (1963) 99-164, "
            "doi:10.1175/1520-0493(1963)091<0099:GCEWTP>2.3.CO;2"};
  }
  explicit Smagorinsky(const Parameters& p) : p_(p) {}

  void evaluate(const sdk::TurbulenceBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) {
      batch.eddy_viscosity[n] =
          formula::eddy_viscosity(p_.coefficient, batch.filter_width, batch.wall_distance[n],
                                  batch.strain_rate[n], batch.density[n]);
    }
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Smagorinsky>(); }

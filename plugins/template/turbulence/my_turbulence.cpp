// SPDX-License-Identifier: Apache-2.0
#include "my_turbulence.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_turbulence;
namespace sdk = dust::sdk;

class MyTurbulence final : public sdk::TurbulenceModel {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    double mixing_length = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::mixing_length, "mixing_length", sdk::dimension::length,
             "Size of the eddies that mix.")
        .symbol("l")
        .at_least(0);
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_turbulence",
            .version = "1.0",
            .summary = "Eddy viscosity of a mixing length.",
            .equation = "\\mu_t = \\rho l^2 |S|, l = min(l, 0.41 d)",
            .source = "Prandtl, Z. angew. Math. Mech. 5 (1925) 136-139"};
  }

  explicit MyTurbulence(const Parameters& p) : p_(p) {}

  // 3. The law on a batch of cells: columns in, columns out; no allocation, no lock, no state.
  void evaluate(const sdk::TurbulenceBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) {
      batch.eddy_viscosity[n] = formula::eddy_viscosity(
          batch.density[n], p_.mixing_length, batch.wall_distance[n], batch.strain_rate[n]);
    }
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyTurbulence>(); }

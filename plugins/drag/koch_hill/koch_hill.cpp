// SPDX-License-Identifier: Apache-2.0
#include "koch_hill.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::koch_hill;
namespace sdk = dust::sdk;

class KochHill final : public sdk::DragLaw {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {.name = "koch_hill",
            .version = "1.0",
            .summary = "Drag in random arrays of spheres from lattice-Boltzmann calculations.",
            .equation = R"(F = \varepsilon^2 (F_0(\varepsilon_p) + F_3(\varepsilon_p) Re / 2))",
            .source =
                "Koch and Hill, Annu. Rev. Fluid Mech. 33 (2001) 619-647, "
                "doi:10.1146/annurev.fluid.33.1.619"};
  }
  explicit KochHill(const Parameters&) {}

  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = formula::factor(batch.reynolds[g], batch.void_fraction[g]);
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<KochHill>(); }

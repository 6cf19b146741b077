// SPDX-License-Identifier: Apache-2.0
#include "abraham.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::abraham;
namespace sdk = dust::sdk;

class Abraham final : public sdk::DragLaw {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {
        .name = "abraham",
        .version = "1.0",
        .summary = "Drag of one sphere from the growth of its boundary layer.",
        .equation =
            R"(F = (1 + \sqrt{Re_p} / 9.06)^2,\ Re_p < 1000;\ F = \frac{0.44}{24} Re_p,\ Re_p \ge 1000;\ Re_p = Re / \varepsilon)",
        .source = "Abraham, Phys. Fluids 13 (1970) 2194-2195, doi:10.1063/1.1693218"};
  }
  explicit Abraham(const Parameters&) {}

  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = formula::factor(batch.reynolds[g], batch.void_fraction[g]);
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Abraham>(); }

// SPDX-License-Identifier: Apache-2.0
#include "schiller_naumann.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::schiller_naumann;
namespace sdk = dust::sdk;

class SchillerNaumann final : public sdk::DragLaw {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {
        .name = "schiller_naumann",
        .version = "1.0",
        .summary = "Drag of one sphere up to Re 1000, constant coefficient beyond.",
        .equation =
            R"(F = 1 + 0.15 Re_p^{0.687},\ Re_p < 1000;\ F = \frac{0.44}{24} Re_p,\ Re_p \ge 1000;\ Re_p = Re / \varepsilon)",
        .source = "Schiller and Naumann, Z. Ver. Dtsch. Ing. 77 (1933) 318-320"};
  }
  explicit SchillerNaumann(const Parameters&) {}

  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = formula::factor(batch.reynolds[g], batch.void_fraction[g]);
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<SchillerNaumann>(); }

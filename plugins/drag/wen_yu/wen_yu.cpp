// SPDX-License-Identifier: Apache-2.0
#include "wen_yu.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::wen_yu;
namespace sdk = dust::sdk;

class WenYu final : public sdk::DragLaw {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {
        .name = "wen_yu",
        .version = "1.0",
        .summary =
            "Drag of a suspension; alone, that of a single sphere after Schiller and Naumann.",
        .equation =
            R"(F = (1 + 0.15 Re^{0.687}) \varepsilon^{-2.65},\ Re < 1000;\ F = \frac{0.44}{24} Re\, \varepsilon^{-2.65},\ Re \ge 1000)",
        .source = "Wen and Yu, Chem. Eng. Prog. Symp. Ser. 62 (1966) 100"};
  }
  explicit WenYu(const Parameters&) {}

  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = formula::factor(batch.reynolds[g], batch.void_fraction[g]);
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<WenYu>(); }

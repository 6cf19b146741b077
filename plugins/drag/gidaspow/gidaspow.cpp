// SPDX-License-Identifier: Apache-2.0
#include "gidaspow.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::gidaspow;
namespace sdk = dust::sdk;

class Gidaspow final : public sdk::DragLaw {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {
        .name = "gidaspow",
        .version = "1.0",
        .summary = "Wen and Yu's drag above a void fraction of 0.8, Ergun's below.",
        .equation = R"(F = F_{Wen-Yu},\ \varepsilon > 0.8;\ F = F_{Ergun},\ \varepsilon \le 0.8)",
        .source = "Gidaspow, Multiphase Flow and Fluidization, Academic Press 1994, chapter 2"};
  }
  explicit Gidaspow(const Parameters&) {}

  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = formula::factor(batch.reynolds[g], batch.void_fraction[g]);
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Gidaspow>(); }

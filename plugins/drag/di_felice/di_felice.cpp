// SPDX-License-Identifier: Apache-2.0
#include "di_felice.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::di_felice;
namespace sdk = dust::sdk;

class DiFelice final : public sdk::DragLaw {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {
        .name = "di_felice",
        .version = "1.0",
        .summary = "Drag of a suspension or a bed, one formula for all void fractions.",
        .equation =
            R"(F = \frac{C_d Re}{24} \varepsilon^{1-\xi},\ C_d = (0.63 + 4.8 / \sqrt{Re})^2,\ \xi = 3.7 - 0.65 \exp(-(1.5 - \log_{10} Re)^2 / 2))",
        .source =
            "Di Felice, Int. J. Multiphase Flow 20 (1994) 153-159, "
            "doi:10.1016/0301-9322(94)90011-6"};
  }
  explicit DiFelice(const Parameters&) {}

  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = formula::factor(batch.reynolds[g], batch.void_fraction[g]);
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<DiFelice>(); }

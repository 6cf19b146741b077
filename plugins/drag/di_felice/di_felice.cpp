// SPDX-License-Identifier: Apache-2.0
#include "di_felice.hpp"

#include "dust/sdk/plugin.hpp"

namespace dust::model::di_felice {
namespace {

class DiFelice final : public sdk::DragLaw {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    sdk::ModelInfo info;
    info.name = "di_felice";
    info.version = "1.0";
    info.summary = "Drag of a suspension or a bed, one formula for all void fractions.";
    info.equation =
        R"(F = \frac{C_d Re}{24} \varepsilon^{1-\xi},\ C_d = (0.63 + 4.8 / \sqrt{Re})^2,\ \xi = 3.7 - 0.65 \exp(-(1.5 - \log_{10} Re)^2 / 2))";
    info.source =
        "Di Felice, Int. J. Multiphase Flow 20 (1994) 153-159, doi:10.1016/0301-9322(94)90011-6";
    return info;
  }
  explicit DiFelice(const Parameters&) {}

  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = factor(batch.reynolds[g], batch.void_fraction[g]);
    }
  }
};

}  // namespace
}  // namespace dust::model::di_felice

DUST_PLUGIN(registrar) { registrar.add<dust::model::di_felice::DiFelice>(); }

// SPDX-License-Identifier: Apache-2.0
#include "stokes.hpp"

#include "dust/sdk/plugin.hpp"

namespace dust::model::stokes {
namespace {

class Stokes final : public sdk::DragLaw {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    sdk::ModelInfo info;
    info.name = "stokes";
    info.version = "1.0";
    info.summary = "Drag of one sphere in creeping flow.";
    info.equation = R"(F = 1)";
    info.source = "Stokes, Trans. Cambridge Phil. Soc. 9 (1851) 8-106";
    return info;
  }
  explicit Stokes(const Parameters&) {}

  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = factor(batch.reynolds[g], batch.void_fraction[g]);
    }
  }
};

}  // namespace
}  // namespace dust::model::stokes

DUST_PLUGIN(registrar) { registrar.add<dust::model::stokes::Stokes>(); }

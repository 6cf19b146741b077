// SPDX-License-Identifier: Apache-2.0
#include "stokes.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::stokes;
namespace sdk = dust::sdk;

class Stokes final : public sdk::DragLaw {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {.name = "stokes",
            .version = "1.0",
            .summary = "Drag of one sphere in creeping flow.",
            .equation = R"(F = 1)",
            .source = "Stokes, Trans. Cambridge Phil. Soc. 9 (1851) 8-106"};
  }
  explicit Stokes(const Parameters&) {}

  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = formula::factor(batch.reynolds[g], batch.void_fraction[g]);
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Stokes>(); }

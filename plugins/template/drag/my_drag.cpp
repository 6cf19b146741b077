// SPDX-License-Identifier: Apache-2.0
#include "my_drag.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_drag;
namespace sdk = dust::sdk;

class MyDrag final : public sdk::DragLaw {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    double exponent = 2.65;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::exponent, "exponent", sdk::dimension::none,
             "How fast the drag grows as the grains get denser.")
        .symbol("n")
        .at_least(0)
        .optional();
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_drag",
            .version = "1.0",
            .summary = "Drag of an isolated sphere times a power of the void fraction.",
            .equation = "F = (1 + 0.15 Re^{0.687}) \\varepsilon^{-n}",
            .source = "Schiller, Naumann, VDI-Z. 77 (1935) 318"};
  }

  explicit MyDrag(const Parameters& p) : p_(p) {}

  // 3. The law on a batch: columns in, columns out; no allocation, no lock, no state.
  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) {
      batch.factor[n] = formula::factor(batch.reynolds[n], batch.void_fraction[n], p_.exponent);
    }
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyDrag>(); }

// SPDX-License-Identifier: Apache-2.0
#include "ergun.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::ergun;
namespace sdk = dust::sdk;

DUST_KERNEL void run(std::size_t count, const double* reynolds, const double* void_fraction,
                     double* result) {
#pragma omp simd
  for (std::size_t g = 0; g < count; ++g)
    result[g] = formula::factor(reynolds[g], void_fraction[g]);
}

class Ergun final : public sdk::DragLaw {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {
        .name = "ergun",
        .version = "1.0",
        .summary = "Drag of the grains of a packed bed.",
        .equation =
            R"(F = \frac{1}{18} \left( 150 \frac{1 - \varepsilon}{\varepsilon} + 1.75 \frac{Re}{\varepsilon} \right))",
        .source = "Ergun, Chem. Eng. Prog. 48 (1952) 89"};
  }
  explicit Ergun(const Parameters&) {}

  void evaluate(const sdk::DragBatch& batch) const override {
    run(batch.count, batch.reynolds, batch.void_fraction, batch.factor);
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Ergun>(); }

// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

#include <stdexcept>

namespace {

/// Works until a grain gets faster than any of the scenario begins with.
struct Brittle final : dust::sdk::DragLaw {
  struct Parameters {};
  static dust::sdk::ModelInfo describe() {
    dust::sdk::ModelInfo info = Drag::describe();
    info.name = "brittle";
    return info;
  }
  static dust::sdk::ParameterSchema schema() { return {}; }
  explicit Brittle(const Parameters&) {}
  void evaluate(const dust::sdk::DragBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) {
      if (batch.reynolds[n] > 100.0) throw std::out_of_range("the table ends at Re = 100");
      batch.factor[n] = 1.0;
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Brittle>(); }

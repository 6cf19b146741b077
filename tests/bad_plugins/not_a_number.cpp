// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

#include <cmath>

namespace {

/// Draws the root of a negative number once a grain is faster than any begins with.
struct Rootless final : dust::sdk::DragLaw {
  struct Parameters {};
  static dust::sdk::ModelInfo describe() {
    dust::sdk::ModelInfo info = Drag::describe();
    info.name = "rootless";
    return info;
  }
  static dust::sdk::ParameterSchema schema() { return {}; }
  explicit Rootless(const Parameters&) {}
  void evaluate(const dust::sdk::DragBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) {
      batch.factor[n] = 1.0 + 0.1 * std::sqrt(100.0 - batch.reynolds[n]);
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Rootless>(); }

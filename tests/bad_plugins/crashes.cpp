// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

#include <cstdlib>

namespace {

enum class Where { evaluate, evaluate_by_pointer, constructor };

/// A drag law that ends the process.
template <Where where>
struct Crashing final : dust::sdk::DragLaw {
  struct Parameters {};
  static dust::sdk::ModelInfo describe() {
    const char* const names[] = {"gives_up", "null_pointer", "stillborn"};
    dust::sdk::ModelInfo info = Drag::describe();
    info.name = names[static_cast<int>(where)];
    return info;
  }
  static dust::sdk::ParameterSchema schema() { return {}; }
  explicit Crashing(const Parameters&) {
    if constexpr (where == Where::constructor) std::abort();
  }
  void evaluate(const dust::sdk::DragBatch& batch) const override {
    if constexpr (where == Where::evaluate) std::abort();
    volatile double* volatile nowhere = nullptr;
    *nowhere = batch.reynolds[0];
  }
};

}  // namespace

DUST_PLUGIN(registrar) {
  registrar.add<Crashing<Where::evaluate>>();
  registrar.add<Crashing<Where::evaluate_by_pointer>>();
  registrar.add<Crashing<Where::constructor>>();
}

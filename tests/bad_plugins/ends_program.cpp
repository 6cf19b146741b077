// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

#include <cstdlib>

namespace {

enum class Where { evaluate, evaluate_quickly, constructor };

bool g_leaves = false;

/// What the library has for as long as the program lives: the engine speaks before it goes.
struct Table {
  ~Table() {
    if (g_leaves) std::abort();
  }
};
const Table k_table;

/// A drag law that ends the program as if all were done.
template <Where where>
struct Leaving final : dust::sdk::DragLaw {
  struct Parameters {};
  static dust::sdk::ModelInfo describe() {
    const char* const names[] = {"leaves", "leaves_quickly", "leaves_early"};
    dust::sdk::ModelInfo info = Drag::describe();
    info.name = names[static_cast<int>(where)];
    return info;
  }
  static dust::sdk::ParameterSchema schema() { return {}; }
  explicit Leaving(const Parameters&) {
    if constexpr (where == Where::constructor) std::exit(0);
  }
  void evaluate(const dust::sdk::DragBatch&) const override {
    g_leaves = true;
    if constexpr (where == Where::evaluate) std::exit(0);
    std::quick_exit(0);
  }
};

}  // namespace

DUST_PLUGIN(registrar) {
  registrar.add<Leaving<Where::evaluate>>();
  registrar.add<Leaving<Where::evaluate_quickly>>();
  registrar.add<Leaving<Where::constructor>>();
}

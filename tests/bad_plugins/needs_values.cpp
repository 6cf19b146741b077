// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

namespace {

/// A law whose table nobody can guess; with one it gives what the table's name is long.
struct Tabled final : dust::sdk::DragLaw {
  struct Parameters {
    std::string table;
  };
  static dust::sdk::ModelInfo describe() {
    return {.name = "tabled",
            .version = "1.0",
            .summary = "Factor from a table.",
            .equation = "F = n",
            .source = "own definition"};
  }
  static dust::sdk::ParameterSchema schema() {
    dust::sdk::SchemaOf<Parameters> s;
    s.text(&Parameters::table, "table", "File of factors.");
    return s.build();
  }
  explicit Tabled(const Parameters& p) : factor_(static_cast<double>(p.table.size())) {}
  void evaluate(const dust::sdk::DragBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) batch.factor[n] = factor_;
  }

 private:
  double factor_;
};

/// Keeps every rule.
struct Smooth final : dust::sdk::DragLaw {
  struct Parameters {};
  static dust::sdk::ModelInfo describe() {
    return {.name = "smooth",
            .version = "1.0",
            .summary = "Factor one.",
            .equation = "F = 1",
            .source = "own definition"};
  }
  static dust::sdk::ParameterSchema schema() { return {}; }
  explicit Smooth(const Parameters&) {}
  void evaluate(const dust::sdk::DragBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) batch.factor[n] = 1.0;
  }
};

}  // namespace

DUST_PLUGIN(registrar) {
  registrar.add<Tabled>();
  registrar.add<Smooth>();
}

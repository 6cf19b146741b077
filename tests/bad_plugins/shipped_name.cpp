// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

/// Another law under the name of a shipped one.
struct Named final : dust::sdk::DragLaw {
  using Parameters = Drag::Parameters;
  static dust::sdk::ModelInfo describe() {
    dust::sdk::ModelInfo info = Drag::describe();
    info.name = "gidaspow";
    return info;
  }
  static dust::sdk::ParameterSchema schema() { return {}; }
  explicit Named(const Parameters& p) : law_(p) {}
  void evaluate(const dust::sdk::DragBatch& batch) const override { law_.evaluate(batch); }

 private:
  Drag law_;
};

DUST_PLUGIN(registrar) { registrar.add<Named>(); }

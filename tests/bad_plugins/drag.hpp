// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/plugin.hpp"

/// A drag law that works, for libraries that are wrong in another way.
struct Drag final : dust::sdk::DragLaw {
  struct Parameters {};
  static dust::sdk::ModelInfo describe() {
    return {.kind = "",
            .name = "constant",
            .version = "1.0",
            .summary = "Factor one.",
            .equation = "",
            .source = "",
            .parameters = {}};
  }
  static dust::sdk::ParameterSchema schema() { return {}; }
  explicit Drag(const Parameters&) {}
  void evaluate(const dust::sdk::DragBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) batch.factor[n] = 1.0;
  }
};

/// Exports a handshake changed by `CHANGE` (statements on `h`) and an entry point that aborts the
/// test program when it is called nevertheless.
#define REFUSED_PLUGIN(CHANGE)                                                                  \
  constexpr dust::sdk::Handshake changed() {                                                    \
    dust::sdk::Handshake h = dust::sdk::make_handshake();                                       \
    CHANGE;                                                                                     \
    return h;                                                                                   \
  }                                                                                             \
  extern "C" __attribute__((visibility("default"))) const dust::sdk::Handshake dust_handshake;  \
  constinit const dust::sdk::Handshake dust_handshake = changed();                              \
  extern "C" __attribute__((visibility("default"))) void dust_register(dust::sdk::Registrar&) { \
    __builtin_trap();                                                                           \
  }

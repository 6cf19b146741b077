// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

extern "C" __attribute__((visibility("default"))) void dust_register(dust::sdk::Registrar&) {
  __builtin_trap();
}

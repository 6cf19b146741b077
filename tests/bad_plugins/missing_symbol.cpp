// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

void an_undefined_function();

DUST_PLUGIN(registrar) {
  an_undefined_function();
  registrar.add<Drag>();
}

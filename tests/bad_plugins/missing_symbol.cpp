// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

void a_function_nobody_defines();

DUST_PLUGIN(registrar) {
  a_function_nobody_defines();
  registrar.add<Drag>();
}

// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

extern "C" double absent_factor();

DUST_PLUGIN(registrar) {
  if (absent_factor() > 0.0) registrar.add<Drag>();
}

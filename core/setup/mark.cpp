// SPDX-License-Identifier: Apache-2.0
#include "setup/mark.hpp"

namespace dust::scenario {

std::string place(const Mark& where) {
  if (where.line <= 0) return where.file;
  return where.file + ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
}

}  // namespace dust::scenario

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace dust::scenario {

/// A place in a scenario file, counted from 1. A value of the command line has file "--set PATH"
/// and line 0.
struct Mark {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column", or "file" alone for places without lines (the command line).
std::string place(const Mark& where);

}  // namespace dust::scenario

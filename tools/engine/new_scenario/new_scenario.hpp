// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace dust::engine {

/// A main size of a scenario to start from.
struct Size {
  const char* option;    ///< "speed": --speed on the command line
  const char* sentence;  ///< what it is
  const char* unit;      ///< whose dimension it has
  const char* by_default;
};

/// What the text of a scenario calls itself.
struct FileNames {
  std::string scenario;  ///< its `name`
  std::string file;      ///< as a shell takes it, without its folder
};

/// A scenario to start from.
struct Starter {
  const char* name;
  const char* sentence;
  std::vector<Size> sizes;
  /// Text of the file; `sizes` in SI, in the order above.
  std::string (*write)(const FileNames& names, const std::vector<double>& sizes);
};

const std::vector<Starter>& starters();

}  // namespace dust::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.hpp"

#include <filesystem>
#include <string>

namespace dust::base {

/// A file that cannot be written: its path, the system's reason and the remedy in one sentence.
class WriteError : public RunError {
 public:
  /// `reason`: errno of the call that failed.
  WriteError(const std::filesystem::path& file, int reason);
};

}  // namespace dust::base

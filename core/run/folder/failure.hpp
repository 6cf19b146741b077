// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace dust::run {

/// Why a run has ended before its time.
struct Failure {
  double time = 0.0;  ///< [s] reached
  std::string reason;
  bool is_of_disk = false;  ///< a file could not be written
};

/// Says it, and how to go on from what is in `folder`.
void log_failure(const std::filesystem::path& folder, const Failure& failure);

}  // namespace dust::run

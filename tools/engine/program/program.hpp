// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace dust::engine {

/// What `engine --version` prints, in one line.
std::string program_text();

/// A command line as a shell takes it, for run.log.
std::string command_text(const std::vector<std::string>& words);

}  // namespace dust::engine

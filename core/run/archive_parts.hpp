// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dust::run {

/// The parts of a checkpoint by name, and what writes or reads each.
using SaveParts = std::vector<std::pair<std::string, std::function<void(sdk::ArchiveWriter&)>>>;
using LoadParts = std::vector<std::pair<std::string, std::function<void(sdk::ArchiveReader&)>>>;

}  // namespace dust::run

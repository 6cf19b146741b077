// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace dust::engine {

/// Allocations of this thread since it began.
std::uint64_t allocations_so_far();

}  // namespace dust::engine

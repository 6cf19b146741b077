// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/impl.hpp"

#include <cstddef>

namespace dust::particles {

/// Looks how near the partner of an entry of the fine list is, and what step [s] the contact would
/// need, where both may be faster by `extra_speed` [m/s] than they are.
Outlook look_out(const Dem::Impl& dem, std::size_t entry, double extra_speed);

}  // namespace dust::particles

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/air/side_faces.hpp"

namespace dust::preflight {

/// Does air pass a side, in or out, at some times of the run?
bool passes_air(const scenario::Setup& setup, std::size_t side, const SideModels& sides);

/// Whether no part of a side is a wall to the air, as is that beside a hood; false where periodic.
bool passes_air_everywhere(const scenario::Setup& setup, std::size_t side, const SideModels& sides);

}  // namespace dust::preflight

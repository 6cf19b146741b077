// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/air/side_faces.hpp"

#include <vector>

namespace dust::preflight {

/// Does air pass a side, in or out, at some times of the run?
bool passes_air(const scenario::Setup& setup, std::size_t side, const SideModels& sides);

/// The faces of a side that air passes at some times of the run, in the order of SideFaces; empty
/// where they are all, or are not asked: of a side of given pressure, or of too many faces.
std::vector<bool> passed_faces(const scenario::Setup& setup, std::size_t side,
                               const SideModels& sides);

/// Whether no part of a side is a wall to the air, as is that beside a hood; false where periodic.
bool passes_air_everywhere(const scenario::Setup& setup, std::size_t side, const SideModels& sides);

}  // namespace dust::preflight

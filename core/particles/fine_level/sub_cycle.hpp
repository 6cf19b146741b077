// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/fine_level/blocks.hpp"
#include "particles/fine_level/fine_scene.hpp"

namespace dust::particles {

/// Takes the particles of a block through the scene's coarse step, in the sub-steps of its level.
void sub_cycle(const FineScene& scene, Block& block);

}  // namespace dust::particles

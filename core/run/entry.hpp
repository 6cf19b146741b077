// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "particles/dem.hpp"

#include <vector>

namespace dust::run {

/// Takes out of `waiting` those grains that touch neither a grain in the domain nor one taken
/// before them, in their order; the others stay and are tried again at the next fluid step. An
/// overlap at entry would be an explosion, and moving either grain aside would be made up.
std::vector<particles::NewGrain> take_free_places(std::vector<particles::NewGrain>& waiting,
                                                  const particles::GrainRows& rows);

void save_waiting(const std::vector<particles::NewGrain>& waiting, sdk::ArchiveWriter& archive);
void load_waiting(std::vector<particles::NewGrain>& waiting, sdk::ArchiveReader& archive);

}  // namespace dust::run

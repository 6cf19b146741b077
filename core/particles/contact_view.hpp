// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/dem.hpp"

#include <vector>

namespace dust::particles {

/// Every contact with its force as the positions, velocities and histories of this moment give it;
/// nothing of the state is changed. In the order of chunks, whatever the number of threads. Costs
/// about one pass over all contacts.
std::vector<ContactRecord> contact_records(const Dem::Impl& dem);

}  // namespace dust::particles

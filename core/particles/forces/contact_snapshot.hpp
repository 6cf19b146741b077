// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/dem.hpp"
#include "particles/forces/contact_forces.hpp"
#include "particles/neighbours/inner_list.hpp"

#include <vector>

namespace dust::particles {

/// All contacts as the next step will find them, evaluated on copies of their histories: for
/// sensors.
std::vector<ContactRecord> contact_snapshot(const ContactScene& scene, const InnerList& lists);

}  // namespace dust::particles

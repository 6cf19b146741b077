// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sphere_parts.hpp"

namespace dust::model::divided {

using sdk::sphere_parts::cap;
using sdk::sphere_parts::corner;
using sdk::sphere_parts::edge;

}  // namespace dust::model::divided

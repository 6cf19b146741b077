// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

REFUSED_PLUGIN(h.size_of[1] += 8)

// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

REFUSED_PLUGIN(h.interface_version += 1)

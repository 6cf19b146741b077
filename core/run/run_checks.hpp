// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"

namespace dust::run {

/// Throws ModelError, with likely causes, where a position or velocity is not a number.
void check_finite(const sdk::GrainColumns& particles);

}  // namespace dust::run

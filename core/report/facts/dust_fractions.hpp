// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/dust_fractions.hpp"

namespace dust::report {

using sdk::aerodynamic_diameter;
using sdk::dust_fractions;
using sdk::DustFractions;

}  // namespace dust::report

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::bodies {

/// std::hypot without its care for numbers that no belt has: ten times faster.
inline double length_of(double a, double b) { return std::sqrt(a * a + b * b); }

}  // namespace dust::bodies

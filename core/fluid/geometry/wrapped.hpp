// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::fluid {

/// The number from 0 to `count` - 1 that `n` is in a periodic direction.
constexpr int wrapped(int n, int count) { return ((n % count) + count) % count; }

}  // namespace dust::fluid

// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model::stokes {

/// Drag on a grain over its Stokes drag [-]: 1, whatever the Reynolds number and the void fraction.
/// Valid for one sphere at Re below about 0.1 (2 to 3 % low there).
/// Source: Stokes (1851), Trans. Cambridge Phil. Soc. 9.
constexpr double factor(double /*reynolds*/, double /*void_fraction*/) { return 1.0; }

}  // namespace dust::model::stokes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/diagnostics.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <vector>

namespace dust::preflight {

/// Warns of openings of bodies and sides (hoods, inlets) that are hardly wider than a cell of the
/// fluid: what they draw or blow comes through whole cells.
void check_opening_cells(const scenario::Setup& setup,
                         const std::vector<scenario::SideOpeningSpec>& openings,
                         scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight

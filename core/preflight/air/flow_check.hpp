// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/air/side_faces.hpp"
#include "scenario/diagnostics.hpp"

namespace dust::preflight {

/// Tells sides that cannot be solved together, with the reason: what a model refuses on its side,
/// rules that do not go together, flows that no side gives way to. Flows are added up over whole
/// sides at some times of the run; where bodies may cover part of a side, only flows that are all
/// of one sign are refused. Warns of cells far from cubic.
void check_flow(const scenario::Setup& setup, const SideModels& sides,
                scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight

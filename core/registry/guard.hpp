// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"

#include <memory>

namespace dust::registry {

/// A model of somebody else's library behind one that looks after it: what it throws, and numbers
/// it gives that are none, end the run with its kind, name and file and with what was expected,
/// instead of a grain that is nowhere some steps later. Results are the model's own, bit for bit.
/// A call costs one more virtual call and a pass over its results per batch. Kinds that are not
/// known here come back as they are.
///
/// Every virtual function of the interfaces is passed on here by hand; a test finds one that is not
/// (tests/unit/registry/guard_forwards_test.py).
///
/// `place` is where the scenario chooses the model, for faults before the run (PlacedFault).
std::unique_ptr<sdk::Model> guarded(std::unique_ptr<sdk::Model> model, const Entry& entry,
                                    const std::string& place = {});

}  // namespace dust::registry

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/rule_runner.hpp"
#include "contract/scenes/contact_bench.hpp"

#include <functional>
#include <string>
#include <vector>

namespace dust::contract {

/// What a law gives to the standard contacts after a few looks: with the materials `is_swapped`,
/// and every look changed by `change`.
using ShowContacts = std::function<std::vector<sdk::Vec3>(
    bool is_swapped, const std::function<std::vector<Touch>(std::vector<Touch>)>& change)>;

/// Rules of every law between two sides: `what` it gives, a force or a couple, is the opposite one
/// seen from the other side, and turns with the world.
void check_symmetry(RuleRunner& runner, const std::string& what, const ShowContacts& show);

}  // namespace dust::contract

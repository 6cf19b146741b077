// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/text/tree.hpp"

#include <string>
#include <vector>

namespace dust::scenario {

/// `interactions:` as a list that is addressed by its pairs of materials. All functions leave alone
/// what is not a list of maps with two materials: the reader tells that.

/// The interaction "sand-belt", in either order; null if there is none.
Node* find_pair(Node& interactions, const std::string& name);
/// "sand-belt" of each, in their order.
std::vector<std::string> pair_names(const Node& interactions);

/// Lays the interactions `over` on those of an included file: a pair that is there is completed key
/// by key (a law under another `model` is replaced), others are added. One that `over` gives twice
/// stays twice, for the reader to refuse.
void merge_pairs(Node& base, Node over);

/// Fills in what `like: [sand, belt]` takes over from another pair; the own keys stay. A `like`
/// that leads nowhere is told and stays in its map, which is then incomplete.
void complete_pairs(Node& interactions, Diagnostics& diagnostics);

}  // namespace dust::scenario

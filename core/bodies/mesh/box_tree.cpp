// SPDX-License-Identifier: Apache-2.0
#include "bodies/mesh/box_tree.hpp"

#include <algorithm>
#include <cstddef>

namespace dust::bodies {
namespace {

using sdk::Vec3;

constexpr std::size_t k_leaf = 4;

}  // namespace

BoxTree::BoxTree(std::vector<Thing> things) {
  if (things.empty()) return;
  grow(things, 0);
  numbers_.reserve(things.size());
  for (const Thing& thing : things) numbers_.push_back(thing.number);
}

/// Halves at the median of the middles along the longest side. The first child follows its parent.
void BoxTree::grow(std::span<Thing> things, std::int32_t begin) {
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  Bounds box;
  Bounds middles;
  for (const Thing& thing : things) {
    include(box, thing.box);
    include(middles, thing.middle);
  }
  nodes_[self].box = box;
  if (things.size() <= k_leaf) {
    nodes_[self].first = begin;
    nodes_[self].count = static_cast<std::int32_t>(things.size());
    return;
  }
  const Vec3 extent = middles.high - middles.low;
  int d = 0;
  if (extent.y > extent[d]) d = 1;
  if (extent.z > extent[d]) d = 2;
  const std::size_t half = things.size() / 2;
  std::nth_element(things.begin(), things.begin() + static_cast<std::ptrdiff_t>(half), things.end(),
                   [d](const Thing& a, const Thing& b) {
                     const double x = a.middle[d];
                     const double y = b.middle[d];
                     return x < y || (x == y && a.number < b.number);
                   });
  grow(things.first(half), begin);
  nodes_[self].first = static_cast<std::int32_t>(nodes_.size());
  grow(things.subspan(half), begin + static_cast<std::int32_t>(half));
}

}  // namespace dust::bodies

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/bounds.hpp"
#include "dust/sdk/vec3.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dust::bodies {

/// Things in boxes, as a binary tree, so that those near a point are found without looking at all.
class BoxTree {
 public:
  struct Thing {
    std::int32_t number = 0;  ///< how look_near() names it
    Bounds box;
    sdk::Vec3 middle;  ///< [m] by which things are parted
  };
  BoxTree() = default;
  explicit BoxTree(std::vector<Thing> things);

  [[nodiscard]] bool is_empty() const { return nodes_.empty(); }
  /// Of all things.
  [[nodiscard]] const Bounds& box() const { return nodes_.front().box; }

  /// Calls look(number) of things whose boxes may be nearer to the point than the root of `limit2`
  /// [m2], those of nearer nodes first. A look may lower the limit: 0 ends it.
  template <class Look>
  void look_near(sdk::Vec3 point, const double& limit2, Look&& look) const {
    if (is_empty()) return;
    constexpr std::size_t k_deepest = 64;  // halving 2^31 things
    std::int32_t stack[k_deepest];
    double stack_distance2[k_deepest];
    std::size_t count = 0;
    stack_distance2[count] = box().distance2(point);
    stack[count++] = 0;
    while (count > 0) {
      const std::int32_t self = stack[--count];
      if (stack_distance2[count] >= limit2) continue;
      const Node& node = nodes_[static_cast<std::size_t>(self)];
      if (node.count > 0) {
        for (std::int32_t q = node.first; q < node.first + node.count; ++q) {
          look(numbers_[static_cast<std::size_t>(q)]);
        }
        continue;
      }
      std::int32_t near = self + 1;
      std::int32_t far = node.first;
      double near2 = nodes_[static_cast<std::size_t>(near)].box.distance2(point);
      double far2 = nodes_[static_cast<std::size_t>(far)].box.distance2(point);
      if (far2 < near2) {
        std::swap(near, far);
        std::swap(near2, far2);
      }
      stack[count] = far;
      stack_distance2[count++] = far2;
      stack[count] = near;
      stack_distance2[count++] = near2;
    }
  }

 private:
  struct Node {
    Bounds box;
    std::int32_t first = 0, count = 0;  ///< things of a leaf; count 0: the second child is first
  };

  void grow(std::span<Thing> things, std::int32_t begin);

  std::vector<Node> nodes_;
  std::vector<std::int32_t> numbers_;  ///< of the things, leaf by leaf
};

}  // namespace dust::bodies

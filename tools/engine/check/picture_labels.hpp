// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "check/picture_frame.hpp"

#include <string>
#include <vector>

namespace dust::engine {

/// Places names beside what they belong to, where no other one stands.
class PictureLabels {
 public:
  explicit PictureLabels(const PictureFrame& frame) : frame_(frame) {}

  /// Keeps names out of a box.
  void keep_free(double low_x, double low_y, double high_x, double high_y) {
    taken_.push_back({low_x, low_y, high_x, high_y});
  }
  /// The name of what is at a point, as near to it as there is room: with a line to it where that
  /// is farther off.
  std::string put(double x, double y, const std::string& text, const std::string& colour);

 private:
  struct Box {
    double low_x, low_y, high_x, high_y;
  };
  [[nodiscard]] bool is_free(const Box& box) const;

  const PictureFrame& frame_;
  std::vector<Box> taken_;
};

}  // namespace dust::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/text.hpp"
#include "setup/setup.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace dust::engine {

/// Coordinate in an SVG text [px].
inline std::string px(double value) { return base::fixed_text(value, 1); }

/// Looks along one axis of the domain; gravity points down where it follows an axis.
class SideView {
 public:
  explicit SideView(const scenario::Setup& setup) : min_(setup.domain.min), max_(setup.domain.max) {
    up_ = 2;
    for (int d = 0; d < 3; ++d) {
      if (std::abs(setup.gravity[d]) > std::abs(setup.gravity[up_])) up_ = d;
    }
    is_flipped_ = setup.gravity[up_] > 0.0;
    across_ = up_ == 0 ? 1 : 0;
    for (int d = 0; d < 3; ++d) {
      if (d != up_ && max_[d] - min_[d] > max_[across_] - min_[across_]) across_ = d;
    }
    scale_ = k_picture / std::max(max_[across_] - min_[across_], max_[up_] - min_[up_]);
  }
  [[nodiscard]] double x(sdk::Vec3 p) const {
    return k_margin + scale_ * (p[across_] - min_[across_]);
  }
  [[nodiscard]] double y(sdk::Vec3 p) const {
    return k_top + scale_ * (is_flipped_ ? p[up_] - min_[up_] : max_[up_] - p[up_]);
  }
  /// The point of the picture in the plane through the middle of the domain.
  [[nodiscard]] sdk::Vec3 in_middle(double x, double y) const {
    sdk::Vec3 p = 0.5 * (min_ + max_);
    p[across_] = min_[across_] + (x - k_margin) / scale_;
    const double down = (y - k_top) / scale_;
    p[up_] = is_flipped_ ? min_[up_] + down : max_[up_] - down;
    return p;
  }
  [[nodiscard]] double width() const { return scale_ * (max_[across_] - min_[across_]); }
  [[nodiscard]] double height() const { return scale_ * (max_[up_] - min_[up_]); }
  [[nodiscard]] double left() const { return k_margin; }
  [[nodiscard]] double right() const { return k_margin + width(); }
  [[nodiscard]] double top() const { return k_top; }
  [[nodiscard]] double bottom() const { return k_top + height(); }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] int across() const { return across_; }
  [[nodiscard]] int up() const { return up_; }
  [[nodiscard]] int depth() const { return 3 - across_ - up_; }
  [[nodiscard]] bool is_flipped() const { return is_flipped_; }

  static constexpr double k_picture = 640.0;  ///< longer side [px]
  static constexpr double k_margin = 40.0;    ///< [px]
  static constexpr double k_top = 84.0;       ///< [px] room for the head

 private:
  sdk::Vec3 min_;
  sdk::Vec3 max_;
  int up_ = 2;
  int across_ = 0;
  bool is_flipped_ = false;
  double scale_ = 1.0;
};

}  // namespace dust::engine

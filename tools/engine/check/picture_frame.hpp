// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "setup/setup.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace dust::engine {

/// Text as it may stand in SVG.
std::string xml_text(const std::string& text);

/// From x and z of the domain to the units of a picture, where what is below has the larger number:
/// the domain's upper left corner is (0, 0), its longer side 1000.
class PictureFrame {
 public:
  static constexpr double k_font = 15.0;
  static constexpr double k_left = 70.0;  ///< margins
  static constexpr double k_top = 56.0;
  static constexpr double k_bottom = 104.0;

  explicit PictureFrame(const scenario::DomainSpec& domain);

  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double height() const { return height_; }
  /// Of the margin on the right: wide beside a narrow domain, so that names have room.
  [[nodiscard]] double right() const { return right_; }
  [[nodiscard]] double x(double at) const { return scale_ * (at - min_.x); }
  [[nodiscard]] double y(double at) const { return scale_ * (max_.z - at); }
  [[nodiscard]] double length(double of) const { return scale_ * of; }
  static std::string text(double value);

  /// The first line of the picture.
  [[nodiscard]] std::string head() const;
  /// Lines at round places, with numbers and units.
  [[nodiscard]] std::string axes() const;
  /// A bar of round length below the axis, at its right end.
  [[nodiscard]] std::string scale_bar() const;

 private:
  [[nodiscard]] std::vector<double> ticks(double low, double high, double pixels) const;
  [[nodiscard]] std::string number(double metres) const;

  sdk::Vec3 min_, max_;
  double scale_;
  double width_, height_, right_;
  std::string_view unit_;
  double factor_;  ///< [m] of the unit
};

/// A label with `anchor` start, middle or end; a halo keeps it apart from lines.
std::string label_text(double x, double y, const std::string& text, const std::string& colour,
                       const char* anchor = "start", double size = PictureFrame::k_font);

}  // namespace dust::engine

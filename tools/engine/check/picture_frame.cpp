// SPDX-License-Identifier: Apache-2.0
#include "check/picture_frame.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>

namespace dust::engine {
namespace {

constexpr double k_longer_side = 1000.0;
constexpr double k_margin = 84.0;
/// Narrower pictures have room for names beside them.
constexpr double k_narrow = 560.0;
constexpr double k_room = 260.0;
constexpr const char* k_soft = "#667";

/// The largest of 1, 2, 5 times a power of ten that is not above `most`.
double round_below(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= most * (1.0 + 1e-9)) return step * power;
  }
  return power;
}

}  // namespace

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string label_text(double x, double y, const std::string& text, const std::string& colour,
                       const char* anchor, double size) {
  return "<text x=\"" + PictureFrame::text(x) + "\" y=\"" + PictureFrame::text(y) + "\" fill=\"" +
         colour + "\" text-anchor=\"" + anchor + "\" font-size=\"" + PictureFrame::text(size) +
         "\">" + xml_text(text) + "</text>\n";
}

PictureFrame::PictureFrame(const scenario::DomainSpec& domain)
    : min_(domain.min), max_(domain.max) {
  const sdk::Vec3 size = max_ - min_;
  scale_ = k_longer_side / std::max(size.x, size.z);
  width_ = scale_ * size.x;
  height_ = scale_ * size.z;
  right_ = width_ < k_narrow ? k_room : k_margin;
  const double extent = std::max({size.x, size.y, size.z});
  const bool is_in_metres = extent >= 2.0;
  const bool is_in_millimetres = extent >= 1e-3;
  unit_ = is_in_metres ? "m" : is_in_millimetres ? "mm" : "um";
  factor_ = is_in_metres ? 1.0 : is_in_millimetres ? 1e-3 : 1e-6;
}

std::string PictureFrame::text(double value) { return base::digits_text(value, 6); }

std::string PictureFrame::number(double metres) const {
  const double value = metres / factor_;
  return base::plain_text(std::abs(value) < 1e-9 ? 0.0 : value, 6);
}

std::string PictureFrame::head() const {
  const double w = k_left + width_ + right_;
  const double h = k_top + height_ + k_bottom;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" + text(-k_left) + " " +
         text(-k_top) + " " + text(w) + " " + text(h) + "\" width=\"" + text(w) + "\" height=\"" +
         text(h) + "\" font-family=\"sans-serif\">\n";
}

std::vector<double> PictureFrame::ticks(double low, double high, double pixels) const {
  const double wanted = std::max(1.0, scale_ * (high - low) / pixels);
  double step = round_below((high - low) / wanted);
  while (scale_ * step < 0.6 * pixels) step *= 2.0;
  std::vector<double> all;
  for (double n = std::ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n) {
    all.push_back(n * step);
  }
  return all;
}

std::string PictureFrame::axes() const {
  std::string lines;
  std::string numbers;
  for (const double at : ticks(min_.x, max_.x, 100.0)) {
    lines += "M" + text(x(at)) + " 0V" + text(height_ + 6.0);
    numbers += label_text(x(at), height_ + 24.0, number(at), k_soft, "middle", 14.0);
  }
  for (const double at : ticks(min_.z, max_.z, 80.0)) {
    lines += "M-6 " + text(y(at)) + "H" + text(width_);
    numbers += label_text(-11.0, y(at) + 5.0, number(at), k_soft, "end", 14.0);
  }
  const std::string unit(unit_);
  return "<path fill=\"none\" stroke=\"#dde1e7\" d=\"" + lines + "\"/>\n" + numbers +
         label_text(width_ + 24.0, height_ + 24.0, "x, " + unit, "#223", "start", 14.0) +
         label_text(-11.0, -14.0, "z, " + unit, "#223", "end", 14.0);
}

std::string PictureFrame::scale_bar() const {
  const double length = round_below(0.3 * (max_.x - min_.x));
  const double low = width_ - scale_ * length;
  const double y = height_ + 46.0;
  return "<path fill=\"none\" stroke=\"#223\" stroke-width=\"2\" d=\"M" + text(low) + " " +
         text(y - 5.0) + "v10M" + text(low) + " " + text(y) + "H" + text(width_) +
         "m0 -5v10\"/>\n" +
         label_text(width_ - 0.5 * scale_ * length, y + 20.0,
                    number(length) + " " + std::string(unit_), "#223", "middle", 14.0);
}

}  // namespace dust::engine

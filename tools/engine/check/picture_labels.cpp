// SPDX-License-Identifier: Apache-2.0
#include "check/picture_labels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::engine {
namespace {

constexpr double k_letter = 0.56;  ///< of the font's size: mean width
constexpr double k_ascent = 0.78;
constexpr double k_first_ring = 14.0;
constexpr double k_next_ring = 14.0;
constexpr int k_rings = 22;
constexpr int k_ways = 16;
constexpr double k_with_line = 26.0;

}  // namespace

bool PictureLabels::is_free(const Box& b) const {
  const bool is_inside = b.low_x >= 2.0 && b.high_x <= frame_.width() + frame_.right() - 4.0 &&
                         b.low_y >= 2.0 && b.high_y <= frame_.height() - 2.0;
  return is_inside && std::none_of(taken_.begin(), taken_.end(), [&](const Box& t) {
           return b.low_x < t.high_x && b.high_x > t.low_x && b.low_y < t.high_y &&
                  b.high_y > t.low_y;
         });
}

std::string PictureLabels::put(double x, double y, const std::string& text,
                               const std::string& colour) {
  const double size = PictureFrame::k_font;
  const double width = k_letter * size * static_cast<double>(text.size());
  for (int ring = 0; ring < k_rings; ++ring) {
    const double reach = k_first_ring + ring * k_next_ring;
    for (int n = 0; n < k_ways; ++n) {
      // Above first, then by turns to the right and to the left of that.
      const double turn = 0.5 * static_cast<double>(n % 2 == 0 ? n : -n - 1);
      const double angle = 0.5 * std::numbers::pi + 2.0 * std::numbers::pi * turn / k_ways;
      const double across = std::cos(angle);
      const double middle = x + reach * across + 0.5 * width * across;
      const double line = y - reach * std::sin(angle);
      const Box box{middle - 0.5 * width - 3.0, line - 0.5 * size - 2.0, middle + 0.5 * width + 3.0,
                    line + 0.5 * size + 2.0};
      if (!is_free(box)) continue;
      taken_.push_back(box);
      std::string out;
      if (reach > k_with_line) {
        const double end_x = std::clamp(x, box.low_x, box.high_x);
        const double end_y = std::clamp(y, box.low_y, box.high_y);
        out = "<path fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"0.8\" d=\"M" +
              PictureFrame::text(x) + " " + PictureFrame::text(y) + "L" +
              PictureFrame::text(end_x) + " " + PictureFrame::text(end_y) + "\"/>\n";
      }
      return out +
             "<g paint-order=\"stroke\" stroke=\"#fff\" stroke-width=\"4\" "
             "stroke-linejoin=\"round\">" +
             label_text(middle, line + 0.5 * k_ascent * size - 1.0, text, colour, "middle") +
             "</g>\n";
    }
  }
  return {};  // no room: its title tells it
}

}  // namespace dust::engine

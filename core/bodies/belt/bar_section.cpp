// SPDX-License-Identifier: Apache-2.0
#include "bodies/belt/bar_section.hpp"

#include "bodies/belt/length_of.hpp"

#include <algorithm>
#include <cmath>

namespace dust::bodies {

BarSection::BarSection(Profile profile, double thickness, double height, double face)
    : profile_(profile), half_(0.5 * thickness), top_(face + height) {
  if (profile == Profile::bar) return;
  radius_ = (half_ * half_ + height * height) / (2.0 * height);
  centre_ = top_ - radius_;
  foot_ = std::sqrt(radius_ * radius_ - centre_ * centre_);
}

double BarSection::reach() const {
  if (profile_ == Profile::bar) return half_;
  return centre_ > 0.0 ? radius_ : foot_;
}

BarSection::Nearest BarSection::nearest(double a, double n) const {
  return profile_ == Profile::bar ? nearest_of_box(a, n) : nearest_of_disc(a, n);
}

BarSection::Nearest BarSection::nearest_of_box(double a, double n) const {
  const double past_a = a - std::clamp(a, -half_, half_);
  const double past_n = n - std::clamp(n, 0.0, top_);
  const double distance = length_of(past_a, past_n);
  if (distance > 0.0) return {distance, past_a / distance, past_n / distance};
  const double to_side = std::abs(a) - half_;
  if (to_side > n - top_) return {to_side, a < 0.0 ? -1.0 : 1.0, 0.0};
  return {n - top_, 0.0, 1.0};
}

BarSection::Nearest BarSection::nearest_of_disc(double a, double n) const {
  const double up = n - centre_;
  const double r = length_of(a, up);
  if (!(r > 0.0)) return {-radius_, 0.0, 1.0};
  // Where the nearest point of the disc is over the middle surface it is the segment's too.
  const bool is_over = r <= radius_ ? n >= 0.0 : centre_ + radius_ * up / r >= 0.0;
  if (is_over) return {r - radius_, a / r, up / r};
  const double past = std::abs(a) - foot_;
  if (past <= 0.0) return {-n, 0.0, -1.0};
  const double distance = length_of(past, n);
  return {distance, (a < 0.0 ? -past : past) / distance, n / distance};
}

std::vector<BarSection::Point> BarSection::outline() const {
  if (profile_ == Profile::bar) {
    return {{-half_, 0.0}, {-half_, top_}, {half_, top_}, {half_, 0.0}};
  }
  constexpr int k_pieces = 8;
  const double widest = std::atan2(foot_, -centre_);
  std::vector<Point> points;
  for (int k = 0; k <= k_pieces; ++k) {
    const double angle = widest * (2.0 * k / k_pieces - 1.0);
    points.push_back({radius_ * std::sin(angle), centre_ + radius_ * std::cos(angle)});
  }
  return points;
}

}  // namespace dust::bodies

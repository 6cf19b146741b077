// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace dust::bodies {

/// Section of a crossbar along the belt: a box, or the segment of a disc through both ends of its
/// foot on the belt's face and its crest, of the radius R = (t^2/4 + h^2)/(2 h), with t its
/// thickness and h its height over the face; docs/theory/conveyors.md. It goes down to the belt's
/// middle surface, where its foot is hidden.
///
/// Coordinates [m]: `a` along the belt from its middle, `n` over the belt's middle surface.
class BarSection {
 public:
  enum class Profile { bar, round };
  /// `face` [m]: the belt's face over its middle surface.
  BarSection(Profile profile, double thickness, double height, double face);

  struct Nearest {
    double distance = 0.0;  ///< [m] negative inside
    double along = 0.0;     ///< outward unit normal
    double over = 0.0;
  };
  /// Of the surface outside the belt; inside, how far it is to that.
  [[nodiscard]] Nearest nearest(double a, double n) const;
  /// How far it goes from its middle along the belt.
  [[nodiscard]] double reach() const;
  /// Its outline from the middle surface over the top and back, for pictures.
  struct Point {
    double a = 0.0;
    double n = 0.0;
  };
  [[nodiscard]] std::vector<Point> outline() const;

 private:
  [[nodiscard]] Nearest nearest_of_box(double a, double n) const;
  [[nodiscard]] Nearest nearest_of_disc(double a, double n) const;

  Profile profile_;
  double half_ = 0.0;    ///< of the thickness
  double top_ = 0.0;     ///< over the middle surface
  double radius_ = 0.0;  ///< of the disc
  double centre_ = 0.0;  ///< of the disc, over the middle surface
  double foot_ = 0.0;    ///< half the disc's width in the middle surface
};

}  // namespace dust::bodies

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/hoods/hood_scene.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace dust::study {

/// A hood that fits at a place: a duct of rectangular section whose end is the opening.
struct HoodSite {
  int place = 0;           ///< number of the place of low pressure
  sdk::Vec3 body_min;      ///< [m] the duct
  sdk::Vec3 body_max;      ///< [m]
  sdk::Vec3 opening_min;   ///< [m] its open end, flat
  sdk::Vec3 opening_max;   ///< [m]
  int axis = 0;            ///< 0, 1, 2: along which it draws
  double moved = 0.0;      ///< [m] from the place to the middle of the opening
  double dust_near = 0.0;  ///< [kg/m3] of dust round the place

  /// [m2] of the opening.
  [[nodiscard]] double area() const;
};

/// [m] An opening that suits the grid and the domain: four cells at least, a sixteenth of the
/// longest side of the domain or more.
[[nodiscard]] double usual_opening(const HoodScene& scene);

/// The duct of `opening` [m] times `opening`, and half as long, whose open end is nearest to the
/// place and that is clear of bodies, the stream and the walls; in front of the end two cells are
/// clear too. Of those at the same distance the one with most dust before its opening, then the one
/// that looks to the stream. A domain narrower than one and a half openings is spanned, as is one
/// between periodic sides where no duct fits that keeps clear of them. Nothing where none fits
/// within one opening of the place.
[[nodiscard]] std::optional<HoodSite> site_at(const LowPressurePlace& place, double opening,
                                              const HoodScene& scene);

/// A place whose hood would stand where that of one before it does.
struct SharedSite {
  int place = 0;  ///< its number
  int with = 0;   ///< that of the one before
};

/// The sites of the first places that have room each for themselves.
struct HoodSites {
  std::vector<HoodSite> sites;
  std::vector<int> without_room;   ///< numbers of places where no hood fits
  std::vector<SharedSite> shared;  ///< places left out because their site is taken
};

/// Sites for up to `count` of the places, in their order. A site is taken where its duct
/// shares more than half of itself with one before.
[[nodiscard]] HoodSites sites_at(std::span<const LowPressurePlace> places, std::size_t count,
                                 double opening, const HoodScene& scene);

}  // namespace dust::study

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::model::liquid_bridge {

/// Constants of a pair of materials.
struct Constants {
  double surface_tension = 0.0;  ///< [N/m] gamma
  double cosine = 1.0;           ///< [-] cos(theta)
  double stretch = 1.0;          ///< [-] 1 + theta/2
  double volume = 0.0;           ///< [m3] of every bridge, or 0
  double relative_volume = 0.0;  ///< [-] over (2 R*)^3, or 0; one of both is set
  double volume_root = 0.0;      ///< [m] cube roots of the two above
  double relative_root = 0.0;    ///< [-]
};

/// The largest volume over (2 R*)^3 of a bridge that is still small and pendular: that of
/// evaluate().
inline constexpr double k_largest_relative_volume = 0.1;
/// Beyond this moisture only two grains below 800 kg/m3 are still so, each in six bridges.
inline constexpr double k_largest_moisture = 0.09;

/// Volume over (2 R*)^3 [-] of a bridge between two moist grains: each puts the liquid that it
/// carries, \f$ M (\rho/\rho_l) (4/3) \pi R^3 \f$, into its k bridges in equal parts, so that
/// \f$ V^* = (4 \pi / 3)(M_i \rho_i + M_j \rho_j) / (k \rho_l) \f$ for two equal grains, R = 2 R*.
/// Where one of the two is dry it is a wall, R = R*, and the part of the other is an eighth of
/// that. `liquid` [kg/m3] is M rho of either. Source: own balance; k, 6 in a dense packing of wet
/// spheres: Kohonen, Geromichalos, Scheel, Schier, Herminghaus, Physica A 339 (2004) 7,
/// doi:10.1016/j.physa.2004.03.047.
inline double relative_volume(double liquid_i, double liquid_j, double liquid_density,
                              double coordination) {
  const double shared =
      4.0 / 3.0 * std::numbers::pi * (liquid_i + liquid_j) / (coordination * liquid_density);
  return liquid_i > 0.0 && liquid_j > 0.0 ? shared : 0.125 * shared;
}

/// Distance [m] at which a bridge breaks: \f$ (1 + \theta/2) V^{1/3} \f$.
/// Source: Lian, Thornton, Adams, J. Colloid Interface Sci. 161 (1993) 138,
/// doi:10.1006/jcis.1993.1452.
[[gnu::always_inline]] inline double rupture_distance(const Constants& k, double radius) {
  return k.stretch * (k.volume_root + k.relative_root * 2.0 * radius);
}

/// Force [N] of a bridge at touch: \f$ 4 \pi R^* \gamma \cos\theta \f$ (two spheres of radius R:
/// 2 pi R gamma cos theta).
[[gnu::always_inline]] inline double force_at_touch(const Constants& k, double radius) {
  return (4.0 * std::numbers::pi) * radius * k.surface_tension * k.cosine;
}

/// One pair, in and out.
struct Bridge {
  double overlap;     ///< [m] d; -d is the gap
  double radius;      ///< [m] R*
  double is_bridged;  ///< 1 from touch to rupture, in and out
  double attraction;  ///< [N] out
};

/// Attraction of a pendular bridge of volume V over a gap S:
/// \f$ F = 4 \pi R^* \gamma \cos\theta / (1 + 1.05 \hat S + 2.5 \hat S^2),\;
/// \hat S = S \sqrt{2 R^* / V} \f$; in touch S = 0. The bridge forms at touch and breaks at
/// rupture_distance.
/// Source: Willett, Adams, Johnson, Seville, Langmuir 16 (2000) 9396, doi:10.1021/la000657y, eq. 12
/// (closed form, spheres of radius R, here 2 R*: Derjaguin's mean). Small bridges, V < 0.1 (2
/// R*)^3.
[[gnu::always_inline]] inline void evaluate(const Constants& k, Bridge& c) {
  const double gap = std::max(-c.overlap, 0.0);
  const double diameter = 2.0 * c.radius;
  const double volume = k.volume + k.relative_volume * diameter * diameter * diameter;
  const bool is_bridged =
      c.overlap >= 0.0 || (c.is_bridged > 0.0 && gap < rupture_distance(k, c.radius));
  const double s = gap * std::sqrt(diameter / volume);
  const double force = force_at_touch(k, c.radius) / (1.0 + s * (1.05 + 2.5 * s));
  c.attraction = is_bridged ? force : 0.0;
  c.is_bridged = is_bridged ? 1.0 : 0.0;
}

}  // namespace dust::model::liquid_bridge

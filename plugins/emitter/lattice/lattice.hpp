// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace dust::model::lattice {

using Point = std::array<double, 3>;

/// Whole cells of a lattice in the box [low, high) [m], along x, y and z; none where high lies
/// below.
inline Point cells_in(const Point& low, const Point& high, double spacing, bool is_face_centred) {
  const double edge = is_face_centred ? std::numbers::sqrt2 * spacing : spacing;
  Point cells{};
  // Extents that are whole multiples of the edge, written in decimal, miss it by rounding.
  for (std::size_t d = 0; d < 3; ++d) {
    cells[d] = std::max(0.0, std::floor((high[d] - low[d]) / edge + 1e-9));
  }
  return cells;
}

/// How many sites they have: a number beyond what any memory holds is one all the same.
inline double count_sites(const Point& low, const Point& high, double spacing,
                          bool is_face_centred) {
  const Point cells = cells_in(low, high, spacing, is_face_centred);
  return (is_face_centred ? 4.0 : 1.0) * cells[0] * cells[1] * cells[2];
}

/// Sites of a lattice in the box [low, high) [m], whole cells only, the box's lower corner a
/// cell's corner. `spacing` [m] is the distance of nearest neighbours.
/// - simple: one site in the middle of each cube of edge `spacing`; solids fraction of touching
///   spheres \f$ \pi/6 \f$;
/// - face_centred: four sites in each cube of edge \f$ \sqrt 2 \f$ `spacing`, an eighth and its
///   face-centred partners; \f$ \pi/\sqrt{18} \f$. A box of whole cells repeats itself
///   periodically.
inline std::vector<Point> sites(const Point& low, const Point& high, double spacing,
                                bool is_face_centred) {
  const double edge = is_face_centred ? std::numbers::sqrt2 * spacing : spacing;
  static constexpr Point k_simple[] = {{0.5, 0.5, 0.5}};
  static constexpr Point k_face_centred[] = {
      {0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}};
  const Point whole = cells_in(low, high, spacing, is_face_centred);
  std::array<long, 3> cells{};
  for (std::size_t d = 0; d < 3; ++d) cells[d] = std::lround(whole[d]);
  std::vector<Point> out;
  for (long k = 0; k < cells[2]; ++k) {
    for (long j = 0; j < cells[1]; ++j) {
      for (long i = 0; i < cells[0]; ++i) {
        const Point corner{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        const auto add = [&](const Point& site) {
          Point x{};
          for (std::size_t d = 0; d < 3; ++d) x[d] = low[d] + edge * (corner[d] + site[d]);
          out.push_back(x);
        };
        if (is_face_centred) {
          for (const Point& site : k_face_centred) add(site);
        } else {
          add(k_simple[0]);
        }
      }
    }
  }
  return out;
}

}  // namespace dust::model::lattice

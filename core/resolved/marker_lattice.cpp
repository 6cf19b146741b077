// SPDX-License-Identifier: Apache-2.0
#include "resolved/marker_lattice.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace dust::resolved {

double retraction(double cells) { return 0.28 + 1.07 / cells; }

double turning_gain(double cells) { return 1.0 + 4.0 / (cells * cells); }

int marker_count(double cells) {
  const double layer = std::numbers::pi / 3.0 * (3.0 * cells * cells + 1.0);
  return static_cast<int>(std::ceil(layer / k_cells_per_marker));
}

/// A spiral of equal areas that turns by the golden angle from point to point (Swinbank and Purser
/// 2006, 10.1256/qj.05.227).
MarkerLattice make_lattice(double diameter, double spacing) {
  const double cells = diameter / spacing;
  const int count = marker_count(cells);
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  MarkerLattice lattice;
  lattice.direction.reserve(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    const double height = 1.0 - (2.0 * n + 1.0) / count;
    const double width = std::sqrt(1.0 - height * height);
    const double angle = golden_angle * n;
    lattice.direction.push_back({width * std::cos(angle), width * std::sin(angle), height});
  }
  lattice.radius = 0.5 * diameter - retraction(cells) * spacing;
  lattice.turning_gain = turning_gain(cells);
  const double layer = std::numbers::pi * spacing / 3.0 *
                       (12.0 * lattice.radius * lattice.radius + spacing * spacing);
  lattice.volume = layer / count;
  return lattice;
}

}  // namespace dust::resolved

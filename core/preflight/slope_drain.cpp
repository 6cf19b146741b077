// SPDX-License-Identifier: Apache-2.0
#include "preflight/slope_drain.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dust::preflight {
namespace {

constexpr double k_solids_of_bed = 0.58;
constexpr double k_slope = 0.75;  // tangent of 37 degrees; sands and ores lie at 34 to 42
/// Time over root(L / g), as scenarios/thesis/container_periodic_8.yaml runs out
/// (tests/unit/preflight/slope_drain_test.cpp).
constexpr double k_runs_out = 2.8;

/// Grains that fill the domain from wall to wall.
struct Bed {
  sdk::Vec3 min, max;  ///< [m]
  int up = 2;          ///< axis

  /// The bed's extent along an axis [m].
  [[nodiscard]] double extent(int axis) const { return max[axis] - min[axis]; }
};

/// Nothing where gravity is not along an axis: the bed's surface would lean.
std::optional<Bed> bed_of(const scenario::Setup& setup, double solids) {
  const double g = norm(setup.gravity);
  Bed bed{setup.domain.min, setup.domain.max};
  for (int d = 0; d < 3; ++d) {
    if (std::abs(setup.gravity[d]) > std::abs(setup.gravity[bed.up])) bed.up = d;
  }
  if (!(g > 0.0) || std::abs(setup.gravity[bed.up]) < 0.999 * g) return {};
  const double filled = solids / (k_solids_of_bed * bed.extent(0) * bed.extent(1) * bed.extent(2));
  const double height = std::min(1.0, filled) * bed.extent(bed.up);
  if (!(height > 0.0)) return {};
  if (setup.gravity[bed.up] < 0.0) {
    bed.max[bed.up] = bed.min[bed.up] + height;
  } else {
    bed.min[bed.up] = bed.max[bed.up] - height;
  }
  return bed;
}

/// Whether the body covers a side of the bed, looked at in a few places.
bool covers(const bodies::Body& body, const Bed& bed, int side, double gap) {
  constexpr int k_places = 4;
  const int axis = side / 2;
  const int first = (axis + 1) % 3;
  const int second = (axis + 2) % 3;
  sdk::Vec3 point = side % 2 == 0 ? bed.min : bed.max;
  for (int i = 0; i < k_places; ++i) {
    point[first] = bed.min[first] + (i + 0.5) / k_places * bed.extent(first);
    for (int j = 0; j < k_places; ++j) {
      point[second] = bed.min[second] + (j + 0.5) / k_places * bed.extent(second);
      if (body.nearest(point).distance > gap) return false;
    }
  }
  return true;
}

double share_above_slope(double height, double depth) {
  const double rise = k_slope * depth;
  return height < rise ? 0.5 * height / rise : 1.0 - 0.5 * rise / height;
}

double removal_time(const scenario::RemovalSpec& removal) {
  return removal.kinetic_energy_per_grain > 0.0 ? removal.after : removal.at;
}

}  // namespace

double SlopeDrain::left(double end) const {
  return end > begin ? share * -std::expm1(-(end - begin) / time) : 0.0;
}

double SlopeDrain::absent(double end) const {
  return end > begin ? share * (end - begin) - time * left(end) : 0.0;
}

SlopeDrain slope_drain(const scenario::Setup& setup, const bodies::BodySet& bodies, double solids,
                       double gap) {
  const std::optional<Bed> bed = bed_of(setup, solids);
  if (!bed) return {};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto& removal = setup.bodies[b].removal;
    for (int side = 0; removal && side < 6; ++side) {
      if (side / 2 == bed->up || setup.domain.sides[side].grains != scenario::GrainSide::open ||
          !covers(bodies[b], *bed, side, gap)) {
        continue;
      }
      const double depth = bed->extent(side / 2);
      return {removal_time(*removal), share_above_slope(bed->extent(bed->up), depth),
              k_runs_out * std::sqrt(depth / norm(setup.gravity))};
    }
  }
  return {};
}

}  // namespace dust::preflight

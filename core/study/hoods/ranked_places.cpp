// SPDX-License-Identifier: Apache-2.0
#include "study/hoods/ranked_places.hpp"

#include "base/named.hpp"
#include "run/dust/hoods.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace dust::study {
namespace {

/// [m2] Of a box that is flat, or nearly so.
double area_of(const ExistingHood& hood) {
  std::array<double, 3> extents{};
  for (int d = 0; d < 3; ++d) extents[static_cast<std::size_t>(d)] = hood.max[d] - hood.min[d];
  std::sort(extents.begin(), extents.end(), std::greater<>());
  return extents[0] * extents[1];
}

/// [kg/m3] In the mean over a box round the place, as far as it lies in the domain.
double dust_near(const LowPressurePlace& place, double opening, const HoodScene& scene) {
  sdk::Vec3 low, high;
  double volume = 1.0;
  for (int d = 0; d < 3; ++d) {
    low[d] = std::max(place.position[d] - opening, scene.min()[d]);
    high[d] = std::min(place.position[d] + opening, scene.max()[d]);
    volume *= high[d] - low[d];
  }
  return volume > 0.0 ? scene.dust_in(low, high) / volume : 0.0;
}

}  // namespace

std::vector<ExistingHood> existing_hoods(const scenario::Setup& setup,
                                         const scenario::DustSetup& dust) {
  std::vector<ExistingHood> hoods;
  for (const particles::Opening& opening : run::openings_of(setup, dust)) {
    ExistingHood hood{opening.name, opening.min, opening.max};
    if (opening.side >= 0) {
      const int normal = opening.side / 2;
      const sdk::Vec3& corner = opening.side % 2 == 0 ? setup.domain.min : setup.domain.max;
      hood.min[normal] = hood.max[normal] = corner[normal];
      for (int d = 0; d < 3; ++d) {
        hood.min[d] = std::max(hood.min[d], setup.domain.min[d]);
        hood.max[d] = std::min(hood.max[d], setup.domain.max[d]);
      }
    } else if (const auto* body = base::find_named(setup.bodies, opening.name);
               body != nullptr && body->frame >= 0) {
      hood.frame = setup.frames[static_cast<std::size_t>(body->frame)];
    }
    hoods.push_back(std::move(hood));
  }
  return hoods;
}

bool is_within_reach(sdk::Vec3 point, const ExistingHood& hood) {
  if (hood.frame) {
    const scenario::FrameSpec& frame = *hood.frame;
    point =
        frame.origin + rotate(point - frame.origin, frame.axis / norm(frame.axis), -frame.angle);
  }
  sdk::Vec3 away;
  for (int d = 0; d < 3; ++d) {
    away[d] = point[d] - std::clamp(point[d], hood.min[d], hood.max[d]);
  }
  return dot(away, away) <= area_of(hood);
}

RankedPlaces ranked_places(std::span<const LowPressurePlace> places,
                           std::span<const ExistingHood> hoods, double opening,
                           const HoodScene& scene) {
  RankedPlaces ranked;
  for (const LowPressurePlace& place : places) {
    const auto hood = std::find_if(hoods.begin(), hoods.end(), [&](const ExistingHood& existing) {
      return is_within_reach(place.position, existing);
    });
    if (hood != hoods.end()) {
      ranked.reached.push_back({place.number, hood->name});
      continue;
    }
    ranked.places.push_back(place);
    ranked.places.back().dust_near = dust_near(place, opening, scene);
  }
  std::stable_sort(ranked.places.begin(), ranked.places.end(), [](const auto& a, const auto& b) {
    return a.dust_near != b.dust_near ? a.dust_near > b.dust_near : a.depth > b.depth;
  });
  return ranked;
}

}  // namespace dust::study
